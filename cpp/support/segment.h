// SPDX-License-Identifier: BSD-3-Clause
// Nearest points of segments, in the plane and in space.
#pragma once

#include <algorithm>

#include "support/vec.h"

namespace carreau {

/// Fraction in [0, 1] of the way from a to b at which the segment is nearest to p; 0 when a = b.
template <typename V>
double fraction_on_segment(V p, V a, V b) noexcept {
  const V d = b - a;
  const double squared = dot(d, d);
  return squared > 0 ? std::clamp(dot(p - a, d) / squared, 0.0, 1.0) : 0;
}

template <typename V>
double squared_distance_to_segment(V p, V a, V b) noexcept {
  const V gap = p - (a + fraction_on_segment(p, a, b) * (b - a));
  return dot(gap, gap);
}

template <typename V>
double distance_to_segment(V p, V a, V b) noexcept {
  return std::sqrt(squared_distance_to_segment(p, a, b));
}

}  // namespace carreau
