// SPDX-License-Identifier: BSD-3-Clause
// The cost of the shapes of a star. Private to plane/optimise.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "plane/kernel/plane_work.h"
#include "plane/kernel/shapes.h"
#include "support/infinity.h"

namespace carreau::plane {

/// The shapes of a star as functions of the place of its vertex. The metrics stay those at the centroids of the triangles
/// where the vertex was: a step of a search moves centroids by a twentieth of an edge.
class FrozenStar {
 public:
  FrozenStar(const PlaneWork& work, int v, const std::vector<std::int32_t>& link) {
    const Triangulation& mesh = work.mesh;
    const Vec2 at = mesh.at(v);
    triangles_.reserve(link.size());
    for (std::size_t k = 0; k < link.size(); ++k) {
      const Vec2 p = mesh.at(link[k]), q = mesh.at(link[k + 1 < link.size() ? k + 1 : 0]);
      const Metric2 m = work.field.at((1.0 / 3) * (at + p + q));
      const Vec2 u = p - at, w = q - at, e = w - u, sum = u + w;
      const double root = 2 * std::numbers::sqrt3 * std::sqrt(std::max(determinant(m), 0.0));
      triangles_.push_back({root * cross(u, w), {root * e.y(), -root * e.x()},
                            squared_length(m, u) + squared_length(m, w) + squared_length(m, e),
                            {2 * (m.a * sum.x() + m.b * sum.y()), 2 * (m.b * sum.x() + m.c * sum.y())}, 2.0 * m});
    }
  }

  /// Sum of cost(shape) over the triangles if the vertex moves by d. Once it is `enough` the rest does not matter. `asked`
  /// counts the evaluated shapes.
  template <typename Cost>
  [[nodiscard]] double cost(const Vec2& d, double enough, const Cost& cost, std::int64_t& asked) const {
    double sum = 0;
    std::size_t k = 0;
    for (; k < triangles_.size() && sum < enough; ++k) {
      const Shape& t = triangles_[k];
      const double area = t.area - dot(t.by_area, d);
      sum += cost(area > 0 ? area / (t.lengths - dot(t.by_lengths, d) + squared_length(t.metric, d)) : 0);
    }
    asked += static_cast<std::int64_t>(k);
    return sum;
  }

 private:
  // The shape is the ratio of an area to the sum of squared lengths, times a constant.
  struct Shape {
    double area;
    Vec2 by_area;
    double lengths;
    Vec2 by_lengths;
    Metric2 metric;
  };
  std::vector<Shape> triangles_;
};

/// A lower bound of the cost of single triangles, and the first triangle of the star to evaluate: moves without gain
/// mostly worsen the triangle that was worst before.
struct StarBound {
  double least;
  std::size_t hardest = 0;
};

/// Sum of cost(shape) over the triangles of v and its link; infinite as soon as it cannot be below `enough`, whatever the
/// remaining triangles cost. `asked` counts the evaluated shapes. A share of `rounding` is left for sums.
template <typename Cost>
double bounded_star_cost(const Shapes& shapes, int v, const std::vector<std::int32_t>& link, double enough, const Cost& cost,
                         StarBound& bound, std::int64_t& asked) {
  constexpr double rounding = 1e-12;
  const std::size_t n = link.size(), first = std::min(bound.hardest, n - 1);
  const double most = enough * (1 + rounding);
  const auto cost_of = [&](std::size_t k) {
    ++asked;
    return cost(shapes.quality_at_centroid(v, link[k], link[k + 1 < n ? k + 1 : 0]));
  };
  const auto least_of = [&](std::size_t triangles) { return bound.least * static_cast<double>(triangles); };
  const double head = cost_of(first);
  if (head + least_of(n - 1) > most) return infinity;
  double sum = 0, highest = head;
  for (std::size_t k = 0; k < n; ++k) {
    const double one = k == first ? head : cost_of(k);
    if (one > highest) highest = one, bound.hardest = k;
    sum += one;
    const double rest = k < first ? head + least_of(n - k - 2) : least_of(n - k - 1);
    if (sum + rest > most) return infinity;
  }
  return sum;
}

}  // namespace carreau::plane
