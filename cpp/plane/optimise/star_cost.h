// SPDX-License-Identifier: BSD-3-Clause
// The cost of the shapes of a star. Private to plane/optimise.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "plane/kernel/shapes.h"
#include "support/infinity.h"

namespace carreau::plane {

/// Sum of cost(shape) over the triangles of v and its link. Once it is `enough` the rest does not matter. `asked`
/// counts the evaluated shapes.
template <typename Cost>
double star_cost(const Shapes& shapes, int v, const std::vector<std::int32_t>& link, double enough, const Cost& cost,
                 std::int64_t& asked) {
  double sum = 0;
  std::size_t k = 0;
  for (; k < link.size() && sum < enough; ++k)
    sum += cost(shapes.quality_at_centroid(v, link[k], link[k + 1 < link.size() ? k + 1 : 0]));
  asked += static_cast<std::int64_t>(k);
  return sum;
}

/// A lower bound of the cost of single triangles, and the first triangle of the star to evaluate: moves without gain
/// mostly worsen the triangle that was worst before.
struct StarBound {
  double least;
  std::size_t hardest = 0;
};

/// star_cost(), but infinite as soon as it cannot be below `enough`, whatever the remaining triangles cost. The sum is in
/// equal order, so the decision is equal. A share of `rounding` is left for sums.
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
