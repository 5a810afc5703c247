// SPDX-License-Identifier: BSD-3-Clause
// Matchings of large weight in the dual graph of triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "support/monitor.h"

namespace carreau {

/// Two triangles that may become one quadrilateral.
struct WeightedPair {
  std::array<std::int32_t, 2> triangles;
  double weight = 0;  ///< > 0
};

/// A set of pairs, no two with a triangle in common, whose weights have a large sum. A greedy choice by weight comes
/// first. Alternating paths and circles of bounded length then improve it until none gains. `count`: of triangles, each
/// in three pairs at most. The result, ascending indices of `pairs`, depends on the arguments alone. Throws Cancelled.
std::vector<std::int32_t> match(std::size_t count, const std::vector<WeightedPair>& pairs, Monitor& monitor);

}  // namespace carreau
