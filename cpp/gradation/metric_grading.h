// SPDX-License-Identifier: BSD-3-Clause
// Gradation of metrics over a composite surface, directions kept (Borouchaki, Hecht and Frey; HDR sec. 1.1.2).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "cad/cad.h"
#include "gradation/gradation.h"
#include "metric/metric2.h"
#include "support/infinity.h"
#include "support/monitor.h"

namespace carreau {

/// A metric of a tangent plane by its sizes along two orthogonal unit tangents.
struct TangentMetric {
  Vec3 d1, d2;
  double h1 = infinity, h2 = h1;

  /// Size along a unit tangent.
  [[nodiscard]] double along(const Vec3& w) const noexcept {
    const double a = dot(w, d1) / h1, b = dot(w, d2) / h2;
    return 1 / std::sqrt(a * a + b * b);
  }
  /// The size that belongs to the unit tangent `w`, a principal direction of another metric nearby. It is h1 if w is d1
  /// and h2 if w is d2. Between them it is geometric by the squares of the cosines, so that nothing jumps where
  /// directions turn (at umbilics by any angle). Not the size along w: of sizes 1 and 100 that is hardly ever the
  /// larger one.
  [[nodiscard]] double matched(const Vec3& w) const noexcept {
    if (h1 == h2 || !std::isfinite(h1) || !std::isfinite(h2)) return std::max(h1, h2);
    const double a = dot(w, d1), b = dot(w, d2), sum = a * a + b * b;
    return sum > 0 ? h1 * std::pow(h2 / h1, b * b / sum) : std::min(h1, h2);
  }
  /// Shrinks both, each as far as it matters along the unit tangent w, until the size along w is at most h. A null
  /// vector, the tangent of a curve that is normal to the plane, bounds nothing.
  void bound_along(Vec3 w, double h) noexcept;
};

/// The sizes of a metric of the parameter plane in the tangent plane; empty where the parametrisation is degenerate. h1
/// is the smaller size; of equal sizes the first is along su.
std::optional<TangentMetric> tangent_metric(const SurfaceJet& jet, Metric2 metric) noexcept;
/// The inverse conversion. The parametrisation must not be degenerate.
Metric2 metric_of(const SurfaceJet& jet, const TangentMetric& sizes) noexcept;

/// Shrinks h2, down to h1 at most, until triangles of these sizes lean against the surface by at most `lean` (a
/// tangent). Their normals also turn by at most as much on half an edge. An edge of length L along d2 leaves its image
/// by L^2 / 8 times the second derivative along it. It leaves it in the normal plane and aside (where images of
/// segments of (u, v) bend), and the vertices beside it are h1 away. The jet holds first and second derivatives.
void bound_lean(const SurfaceJet& jet, double lean, TangentMetric& sizes) noexcept;

/// A metric known beside a place, `way` from it in its tangent plane.
struct MetricSource {
  int place = 0;
  TangentMetric sizes;
  Vec3 way;
};

/// Sizes no larger than `sizes` (one a place), along unchanged directions, that obey the gradation (Hc-correction).
/// Along the directions of Q, and along PQ, no size exceeds (1 + slope length_P(PQ)) times the size of P. P is any
/// place or middle of an edge in a triangle of Q, in the tangent plane rolled along the edge, across creases by the
/// curve. Growth along straight lines follows the source's metric as a whole, whatever the number of edges on the way.
/// `slope` is kept within 2 % in all directions on graphs whose triangles are nearly equilateral in the metric. Throws
/// InvalidArgument unless slope > 0 and the arrays fit.
std::vector<TangentMetric> grade_metrics(const GradationGraph& graph, std::vector<TangentMetric> sizes,
                                         const std::vector<MetricSource>& sources, double slope, Monitor& monitor);

}  // namespace carreau
