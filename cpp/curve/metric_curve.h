// SPDX-License-Identifier: BSD-3-Clause
// A curve of the plane or of space with metrics at points of it: the unit discretisation of RR-2818 sec. 4.
#pragma once

#include <span>
#include <vector>

#include "curve/metric_length_table.h"
#include "metric/metric2.h"
#include "metric/metric2_algebra.h"
#include "metric/metric3_algebra.h"
#include "support/vec.h"

namespace carreau {

/// A curve in edges of equal metric length.
struct MetricSplit {
  std::vector<double> cuts;  ///< usual abscissae, from 0 to the length of the curve
  double length = 0;         ///< of the whole curve in the metric
};

/// A polyline of points (two or more) and metrics known at usual abscissae along it, from 0 to the polyline's length.
/// (Vec2, Metric2) or (Vec3, Metric3).
template <typename V, typename M>
class MetricCurve {
 public:
  /// `abscissae` ascend strictly from 0 to the length of the polyline; the last one is within one part in a million of
  /// the length, and moved there. metrics[i] holds at abscissae[i]. Throws InvalidArgument when the arrays do not fit,
  /// a number is not finite, or a metric is not positive definite.
  MetricCurve(std::vector<V> points, std::vector<double> abscissae, std::vector<M> metrics, MetricLaw law);

  [[nodiscard]] V point_at(double s) const noexcept;
  /// Interpolated between the two metrics around s (RR-2818 sec. 4.3.3).
  [[nodiscard]] M metric_at(double s) const;
  /// Length in the metric, and the points that were evaluated for it.
  [[nodiscard]] MetricLengthTable gradation(double lss = 0.5) const;
  /// Length in the metric, and the abscissae of unit_edge_count() edges of equal metric length (algorithm (A) of RR-2818
  /// sec. 4.1). If all metrics are isotropic, both come from the closed forms of sec. 5, and lss has no effect.
  [[nodiscard]] MetricSplit split(double lss = 0.5) const;

 private:
  /// The sizes of metrics that are multiples of the unit matrix, or nothing.
  [[nodiscard]] std::vector<double> isotropic_sizes() const;
  [[nodiscard]] std::size_t edge_at(double s) const noexcept;

  std::vector<V> points_;
  std::vector<double> arc_;  // of points_
  std::vector<double> s_;    // of metrics_
  std::vector<M> metrics_;
  MetricLaw law_;
};

using PlaneMetricCurve = MetricCurve<Vec2, Metric2>;
using SpaceMetricCurve = MetricCurve<Vec3, Metric3>;
extern template class MetricCurve<Vec2, Metric2>;
extern template class MetricCurve<Vec3, Metric3>;

}  // namespace carreau
