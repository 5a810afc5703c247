#include "cad/host_metrics.h"

#include <cmath>
#include <limits>
#include <string>

#include "cad/host_cad.h"
#include "cad/host_exceptions.h"
#include "metric/metric3_algebra.h"
#include "support/format.h"

namespace carreau {

namespace {

/// What a callback does not write must not pass for a value.
struct Answer {
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();
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

Prescription HostMetrics::on_surface(int face, Vec2 uv, Vec3 /*xyz*/) {
  if (table_.surface_metric == nullptr) return {};
  Answer a;
  const Where where{.face = face, .uv = uv};
  const std::int32_t status = ask_host(
      where, "surface_metric", [&] { return table_.surface_metric(face, uv.x(), uv.y(), &a.kind, a.value, table_.user); });
  return prescription_of(status, a, where, "surface_metric");
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
