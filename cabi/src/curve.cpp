// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <limits>

#include "arguments.h"
#include "curve/metric_curve.h"
#include "guard.h"
#include "metric_rows.h"

using carreau::InvalidArgument;
using carreau::Metric2;
using carreau::Metric3;
using carreau::MetricLaw;
using carreau::MetricSplit;
using carreau::Vec2;
using carreau::Vec3;
using namespace carreau::abi;

namespace {

/// n rows of `width` numbers.
template <typename T>
std::vector<T> rows(const double* values, std::int64_t n, int width, const char* name) {
  required(values, name);
  std::vector<T> result(static_cast<std::size_t>(n));
  for (std::size_t i = 0; i < result.size(); ++i) read(values + i * static_cast<std::size_t>(width), result[i]);
  return result;
}

template <typename V, typename M>
MetricSplit split(const carreau_curve& curve, int point_width, int metric_width) {
  const std::vector<double> abscissae(required(curve.abscissae, "curve->abscissae"),
                                      curve.abscissae + curve.metric_count);
  const carreau::MetricCurve<V, M> measured(
      rows<V>(curve.points, curve.point_count, point_width, "curve->points"), abscissae,
      rows<M>(curve.metrics, curve.metric_count, metric_width, "curve->metrics"), static_cast<MetricLaw>(curve.law));
  return measured.split(curve.lss != 0 ? curve.lss : 0.5);
}

MetricSplit split(const carreau_curve& curve) {
  if (curve.law < 0 || curve.law > 2)
    throw InvalidArgument("curve->law is " + std::to_string(curve.law) +
                          "; it must be 0 (linear), 1 (geometric) or 2 (sinusoidal)");
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  for (const std::int64_t count : {curve.point_count, curve.metric_count})
    if (count < 2 || count > most)
      throw InvalidArgument("a curve needs between 2 and " + std::to_string(most) +
                            " points, and as many metrics; there are " + std::to_string(curve.point_count) + " and " +
                            std::to_string(curve.metric_count));
  if (curve.dimension == 2) return split<Vec2, Metric2>(curve, 2, 3);
  if (curve.dimension == 3) return split<Vec3, Metric3>(curve, 3, 6);
  throw InvalidArgument("curve->dimension is " + std::to_string(curve.dimension) + "; it must be 2 or 3");
}

}  // namespace

carreau_status carreau_curve_split(carreau_session* session, const carreau_curve* curve, int64_t capacity,
                                   double* out_abscissae, int64_t* out_edges, double* out_length) {
  return guarded(session, [&] {
    const MetricSplit result = split(read_struct(curve, "curve"));
    if (out_abscissae != nullptr && capacity != 0) {
      check_capacity(capacity, result.cuts.size(), "abscissae");
      std::copy(result.cuts.begin(), result.cuts.end(), out_abscissae);
    }
    if (out_edges != nullptr) *out_edges = static_cast<std::int64_t>(result.cuts.size()) - 1;
    if (out_length != nullptr) *out_length = result.length;
  });
}
