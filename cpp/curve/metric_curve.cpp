// SPDX-License-Identifier: BSD-3-Clause
#include "curve/metric_curve.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "curve/unit_discretisation.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {
namespace {

template <typename V>
std::vector<double> cumulated_lengths(const std::vector<V>& points) {
  if (points.size() < 2) throw InvalidArgument("a curve needs two points at least");
  std::vector<double> arc{0};
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_finite(points[i])) throw InvalidArgument("point " + std::to_string(i) + " of a curve is not finite");
    if (i == 0) continue;
    arc.push_back(arc.back() + norm(points[i] - points[i - 1]));
    if (!(arc[i] > arc[i - 1]))
      throw InvalidArgument("points " + std::to_string(i - 1) + " and " + std::to_string(i) + " of a curve coincide");
  }
  return arc;
}

std::size_t interval_of(const std::vector<double>& s, double at) noexcept {
  const auto above = static_cast<std::size_t>(std::upper_bound(s.begin(), s.end(), at) - s.begin());
  return std::clamp<std::size_t>(above, 1, s.size() - 1) - 1;
}

/// Entries of a multiple of the unit matrix may differ by this share, which is rounding.
constexpr double isotropy = 1e-13;
/// Returns the factor of a multiple of the unit matrix, or 0.
double isotropic_factor(const Metric2& m) noexcept {
  return std::max(std::abs(m.b), std::abs(m.c - m.a)) <= isotropy * m.a ? m.a : 0;
}
double isotropic_factor(const Metric3& m) noexcept {
  const double off = std::max({std::abs(m.xy), std::abs(m.xz), std::abs(m.yz), std::abs(m.yy - m.xx), std::abs(m.zz - m.xx)});
  return off <= isotropy * m.xx ? m.xx : 0;
}

}  // namespace

template <typename V, typename M>
MetricCurve<V, M>::MetricCurve(std::vector<V> points, std::vector<double> abscissae, std::vector<M> metrics,
                               MetricLaw law)
    : points_(std::move(points)),
      arc_(cumulated_lengths(points_)),
      s_(std::move(abscissae)),
      metrics_(std::move(metrics)),
      law_(law) {
  if (s_.size() != metrics_.size() || s_.size() < 2)
    throw InvalidArgument("a curve needs as many metrics as abscissae, and at least two; there are " +
                          std::to_string(metrics_.size()) + " and " + std::to_string(s_.size()));
  const double total = arc_.back();
  if (s_.front() != 0 || !(std::abs(s_.back() - total) <= 1e-6 * total))
    throw InvalidArgument("metrics must be known from one end of a curve to the other, abscissae 0 and " +
                          format_number(total) + "; they go from " + format_number(s_.front()) + " to " +
                          format_number(s_.back()));
  s_.back() = total;
  for (std::size_t i = 0; i < s_.size(); ++i) {
    if (i > 0 && !(s_[i] > s_[i - 1]))
      throw InvalidArgument("abscissae of metrics along a curve must ascend; number " + std::to_string(i) + " is " +
                            format_number(s_[i]));
    if (!is_positive_definite(metrics_[i]))
      throw InvalidArgument("metric " + std::to_string(i) + " along a curve is not positive definite");
  }
}

template <typename V, typename M>
std::size_t MetricCurve<V, M>::edge_at(double s) const noexcept {
  return interval_of(arc_, s);
}

template <typename V, typename M>
V MetricCurve<V, M>::point_at(double s) const noexcept {
  const std::size_t i = edge_at(s);
  return lerp(points_[i], points_[i + 1], std::clamp((s - arc_[i]) / (arc_[i + 1] - arc_[i]), 0., 1.));
}

template <typename V, typename M>
M MetricCurve<V, M>::metric_at(double s) const {
  const std::size_t i = interval_of(s_, s);
  return interpolate(metrics_[i], metrics_[i + 1], std::clamp((s - s_[i]) / (s_[i + 1] - s_[i]), 0., 1.), law_);
}

template <typename V, typename M>
MetricLengthTable MetricCurve<V, M>::gradation(double lss) const {
  // The speed jumps where the polyline turns, its slope where a metric is given: both end a trapezoid.
  std::vector<double> breaks(arc_.size() + s_.size());
  std::merge(arc_.begin(), arc_.end(), s_.begin(), s_.end(), breaks.begin());
  const double least = 1e-12 * arc_.back();
  const auto close = [&](double p, double q) { return q - p <= least; };
  breaks.erase(std::unique(breaks.begin(), breaks.end(), close), breaks.end());
  breaks.back() = arc_.back();
  const auto speed = [&](std::size_t piece, double s) {
    const std::size_t edge = edge_at((breaks[piece] + breaks[piece + 1]) / 2);
    const V tangent = (1 / (arc_[edge + 1] - arc_[edge])) * (points_[edge + 1] - points_[edge]);
    return length(metric_at(s), tangent);
  };
  return measure_curve(speed, breaks, lss);
}

template <typename V, typename M>
std::vector<double> MetricCurve<V, M>::isotropic_sizes() const {
  std::vector<double> sizes;
  for (const M& metric : metrics_) {
    const double factor = isotropic_factor(metric);
    if (factor == 0) return {};
    sizes.push_back(1 / std::sqrt(factor));
  }
  return sizes;
}

template <typename V, typename M>
MetricSplit MetricCurve<V, M>::split(double lss) const {
  if (const std::vector<double> sizes = isotropic_sizes(); !sizes.empty() && lss > 0) {
    return {split_by_sizes(s_, sizes, law_), normalised_length(s_, sizes, law_)};
  }
  const MetricLengthTable measured = gradation(lss);
  return {split_equally(measured, unit_edge_count(measured.length())), measured.length()};
}

template class MetricCurve<Vec2, Metric2>;
template class MetricCurve<Vec3, Metric3>;

}  // namespace carreau
