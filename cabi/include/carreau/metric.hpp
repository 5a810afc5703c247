// SPDX-License-Identifier: BSD-3-Clause
/// Algebra of metrics and curves in metrics: see carreau.hpp.
#ifndef CARREAU_METRIC_HPP
#define CARREAU_METRIC_HPP

#include "session.hpp"

/// For n metrics of one dimension, 2 or 3, at once: rows of 3 numbers (xx xy yy) or of 6 (xx xy xz yy yz zz), in 1 / model length^2. Sizes
/// are n x dimension, axes n x dimension x dimension. Errors: ARGUMENT (numbers of rows that do not agree, a metric that is not positive
/// definite).
namespace carreau::metric {

/// Sizes of metrics along their axes.
struct Axes {
  std::vector<double> sizes; ///< along each axis, the smallest first
  std::vector<double> axes;  ///< unit vectors, one after another
};
/// The simultaneous reduction of two metrics: their sizes along common directions.
struct Reduction {
  std::vector<double> p_sizes, q_sizes;
  std::vector<double> directions; ///< orthogonal in both metrics, unit vectors
};
/// A curve cut into edges of equal length in its metric.
struct CurveSplit {
  std::vector<double> abscissae; ///< usual lengths from the first point, one more than edges
  double length = 0;             ///< of the whole curve in the metric
};

namespace detail {

using carreau::detail::count_of;
using carreau::detail::data_or_null;

/// Numbers of a metric.
constexpr std::size_t tensor_of(int dimension) { return dimension == 2 ? 3 : 6; }

/// The number of rows of an array, which must hold whole rows and, if given, `wanted` rows.
inline std::size_t rows_of(std::span<const double> array, std::size_t width, std::optional<std::size_t> wanted = {}) {
  const std::size_t n = array.size() / width;
  if (n * width != array.size() || (wanted && n != *wanted))
    carreau::detail::fail(CARREAU_ERR_ARGUMENT, "The arrays of metrics have numbers of rows that do not agree.");
  return n;
}

} // namespace detail

inline Axes sizes(int dimension, std::span<const double> metrics) {
  const Session session;
  const auto d = static_cast<std::size_t>(dimension);
  const std::size_t n = detail::rows_of(metrics, detail::tensor_of(dimension));
  Axes out{std::vector<double>(n * d), std::vector<double>(n * d * d)};
  session.done(carreau_metric_sizes(session.get(), dimension, detail::count_of(n), metrics.data(), out.sizes.data(), out.axes.data()));
  return out;
}

inline std::vector<double> of_sizes(int dimension, std::span<const double> sizes, std::span<const double> axes) {
  const Session session;
  const auto d = static_cast<std::size_t>(dimension);
  const std::size_t n = detail::rows_of(sizes, d);
  detail::rows_of(axes, d * d, n);
  std::vector<double> out(n * detail::tensor_of(dimension));
  session.done(carreau_metric_of_sizes(session.get(), dimension, detail::count_of(n), sizes.data(), axes.data(), out.data()));
  return out;
}

/// law: 0 linear, 1 geometric, 2 sinusoidal (RR-2818 sec. 4.3.2). share: in [0, 1], from p to q.
inline std::vector<double> interpolate(int dimension, int law, std::span<const double> p, std::span<const double> q,
                                       std::span<const double> share) {
  const Session session;
  const std::size_t n = detail::rows_of(p, detail::tensor_of(dimension));
  detail::rows_of(q, detail::tensor_of(dimension), n);
  detail::rows_of(share, 1, n);
  std::vector<double> out(p.size());
  session.done(carreau_metric_interpolate(session.get(), dimension, law, detail::count_of(n), p.data(), q.data(), share.data(), out.data()));
  return out;
}

/// `count` metrics at each of n places: rows of n x count. how: CARREAU_INTERSECT_...
inline std::vector<double> intersect(int dimension, int how, std::size_t count, std::span<const double> metrics) {
  const Session session;
  const std::size_t n = detail::rows_of(metrics, detail::tensor_of(dimension) * std::max<std::size_t>(count, 1));
  std::vector<double> out(n * detail::tensor_of(dimension));
  session.done(
      carreau_metric_intersect(session.get(), dimension, how, detail::count_of(n), detail::count_of(count), metrics.data(), out.data()));
  return out;
}

inline Reduction reduce(int dimension, std::span<const double> p, std::span<const double> q) {
  const Session session;
  const auto d = static_cast<std::size_t>(dimension);
  const std::size_t n = detail::rows_of(p, detail::tensor_of(dimension));
  detail::rows_of(q, detail::tensor_of(dimension), n);
  Reduction out{std::vector<double>(n * d), std::vector<double>(n * d), std::vector<double>(n * d * d)};
  session.done(carreau_metric_reduce(session.get(), dimension, detail::count_of(n), p.data(), q.data(), out.p_sizes.data(),
                                     out.q_sizes.data(), out.directions.data()));
  return out;
}

/// Edges are n x 2 x dimension coordinates, metrics n x 2 rows.
inline std::vector<double> lengths(int dimension, int law, std::span<const double> edges, std::span<const double> metrics) {
  const Session session;
  const std::size_t n = detail::rows_of(edges, 2 * static_cast<std::size_t>(dimension));
  detail::rows_of(metrics, 2 * detail::tensor_of(dimension), n);
  std::vector<double> out(n);
  session.done(carreau_metric_lengths(session.get(), dimension, law, detail::count_of(n), edges.data(), metrics.data(), out.data()));
  return out;
}

/// Cuts a polyline of n points (n x dimension) into edges of equal length in metrics that are known at usual lengths along it.
inline CurveSplit curve_split(int dimension, std::span<const double> points, std::span<const double> abscissae,
                              std::span<const double> metrics, int law = 1, double lss = 0) {
  const Session session;
  auto curve = carreau::detail::sized<carreau_curve>();
  detail::rows_of(metrics, detail::tensor_of(dimension), abscissae.size());
  curve.dimension = dimension;
  curve.law = law;
  curve.point_count = detail::count_of(detail::rows_of(points, static_cast<std::size_t>(dimension)));
  curve.metric_count = detail::count_of(abscissae.size());
  curve.points = points.data();
  curve.abscissae = abscissae.data();
  curve.metrics = metrics.data();
  curve.lss = lss;
  CurveSplit out;
  std::int64_t edges = 0;
  session.done(carreau_curve_split(session.get(), &curve, 0, nullptr, &edges, &out.length));
  out.abscissae.resize(static_cast<std::size_t>(edges) + 1);
  session.done(carreau_curve_split(session.get(), &curve, edges + 1, out.abscissae.data(), nullptr, nullptr));
  return out;
}

} // namespace carreau::metric

#endif
