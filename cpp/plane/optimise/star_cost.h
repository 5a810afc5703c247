// SPDX-License-Identifier: BSD-3-Clause
// What the shapes of a star cost. Private to plane/optimise.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "plane/kernel/shapes.h"

namespace carreau::plane {

/// Sum of cost(shape) over the triangles of v and its link. Once it is `enough` the rest does not matter. `asked`
/// counts the shapes asked for.
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

}  // namespace carreau::plane
