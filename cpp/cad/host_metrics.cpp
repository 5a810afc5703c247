// SPDX-License-Identifier: BSD-3-Clause
#include "cad/host_metrics.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "cad/host_cad.h"
#include "cad/host_exceptions.h"
#include "metric/metric3_algebra.h"
#include "support/format.h"
#include "support/infinity.h"
#include "support/pieces.h"

namespace carreau {

namespace {

/// Points of one batch: bounds the memory of the arrays that cross.
constexpr std::size_t metric_batch = 4096;

/// A value that a callback does not write must not pass for a result.
struct Answer {
  std::int32_t kind = 0;
  double value[host_metric_values] = {nan, nan, nan, nan, nan, nan};
};

Prescription tangent_metric(const double* value, const Where& where, const std::string& callback) {
  const double h1 = value[0], h2 = value[1];
  const Vec3 direction{value[2], value[3], value[4]};
  const auto positive = [](double h) { return h > 0 && std::isfinite(h); };
  if (!positive(h1) || !positive(h2)) {
    throw CallbackError(where, callback + " returned the sizes " + format_number(h1) + " and " + format_number(h2) +
                                   ", which must be positive");
  }
  if (!is_finite(direction) || !(norm(direction) > 0)) {
    throw CallbackError(where, callback + " returned the direction (" + format_number(direction.x()) + ", " +
                                   format_number(direction.y()) + ", " + format_number(direction.z()) +
                                   "), which must be finite and not zero");
  }
  return Prescription::of_space(metric_of_sizes(direction, h1, h2));
}

Prescription prescription_of(std::int32_t status, const Answer& answer, const Where& where, const char* name) {
  if (status == no_answer_status) return {};
  const std::string callback = std::string("the callback ") + name;
  if (status != 0) throw CallbackError(where, callback + " returned the status " + std::to_string(status));
  const double* v = answer.value;
  switch (static_cast<HostMetricKind>(answer.kind)) {
    case HostMetricKind::none:
      return {};
    case HostMetricKind::size:
      return v[0] == no_answer ? Prescription{} : Prescription::of_size(v[0]);
    case HostMetricKind::space:
      return Prescription::of_space({v[0], v[1], v[2], v[3], v[4], v[5]});
    case HostMetricKind::tangent:
      return tangent_metric(v, where, callback);
  }
  throw CallbackError(where, callback + " returned the kind " + std::to_string(answer.kind) + ", which does not exist");
}

}  // namespace

Prescription HostMetrics::on_surface(int face, Vec2 uv, Vec3 xyz) {
  if (table_.surface_metric_batch != nullptr) {
    Prescription answer;
    ask_batch(face, {&uv, 1}, {&xyz, 1}, {&answer, 1});
    return answer;
  }
  if (table_.surface_metric == nullptr) return {};
  Answer a;
  const Where where{.face = face, .uv = uv};
  const std::int32_t status = ask_host(
      where, "surface_metric", [&] { return table_.surface_metric(face, uv.x(), uv.y(), &a.kind, a.value, table_.user); });
  return prescription_of(status, a, where, "surface_metric");
}

void HostMetrics::on_surface_points(int face, std::span<const Vec2> uv, std::span<const Vec3> xyz,
                                    std::span<Prescription> out) {
  if (table_.surface_metric_batch == nullptr) return PrescriptionSource::on_surface_points(face, uv, xyz, out);
  for_pieces(uv.size(), metric_batch, [&](std::size_t first, std::size_t n) {
    ask_batch(face, uv.subspan(first, n), xyz.subspan(first, n), out.subspan(first, n));
  });
}

void HostMetrics::ask_batch(int face, std::span<const Vec2> uv, std::span<const Vec3> xyz,
                            std::span<Prescription> out) const {
  constexpr const char* name = "surface_metric_batch";
  const std::size_t n = uv.size();
  std::vector<double> places(2 * n), points(3 * n), values(host_metric_values * n, nan);
  std::vector<std::int32_t> kinds(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < 2; ++k) places[2 * i + k] = uv[i][Eigen::Index(k)];
    for (std::size_t k = 0; k < 3; ++k) points[3 * i + k] = xyz[i][Eigen::Index(k)];
  }
  const Where first{.face = face, .uv = uv.front()};
  const std::int32_t status = ask_host(first, name, [&] {
    return table_.surface_metric_batch(face, static_cast<std::int64_t>(n), places.data(), points.data(), kinds.data(),
                                       values.data(), table_.user);
  });
  for (std::size_t i = 0; i < n; ++i) {
    Answer answer{.kind = kinds[i]};
    std::copy_n(&values[host_metric_values * i], host_metric_values, answer.value);
    out[i] = prescription_of(status, answer, {.face = face, .uv = uv[i]}, name);
  }
}

Prescription HostMetrics::on_curve(int face, int ic, double t, Vec2 /*uv*/, Vec3 /*xyz*/) {
  if (table_.curve_metric == nullptr) return {};
  Answer a;
  const Where where{.face = face, .curve_index = ic, .t = t};
  const std::int32_t status =
      ask_host(where, "curve_metric", [&] { return table_.curve_metric(face, ic, t, &a.kind, a.value, table_.user); });
  return prescription_of(status, a, where, "curve_metric");
}

Prescription HostMetrics::at_point(int point, Vec3 /*xyz*/) {
  if (table_.point_metric == nullptr) return {};
  Answer a;
  const Where where{.point = point};
  const std::int32_t status =
      ask_host(where, "point_metric", [&] { return table_.point_metric(point, &a.kind, a.value, table_.user); });
  return prescription_of(status, a, where, "point_metric");
}

}  // namespace carreau
