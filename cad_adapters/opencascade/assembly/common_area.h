// SPDX-License-Identifier: BSD-3-Clause
// The area that two regions of a plane have in common.
#pragma once

#include <array>
#include <vector>

namespace carreau_occ {

/// A piece of the border of a region.
struct Segment {
  std::array<double, 2> a{}, b{};
};

/// Regions are the points from which a ray crosses an odd number of segments. Exact but for rounding, except that borders
/// of both regions that cross are found to 2^-20 of the distance between their ends. `inside` gets a point of both regions.
double common_area(const std::vector<Segment>& p, const std::vector<Segment>& q, std::array<double, 2>& inside);

}  // namespace carreau_occ
