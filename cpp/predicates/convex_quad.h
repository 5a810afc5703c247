// SPDX-License-Identifier: BSD-3-Clause
// Decides exactly if four points are the corners of a convex quadrilateral.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "predicates/predicates.h"

namespace carreau {

/// Strictly convex and counterclockwise: the four orientations of three corners that follow each other are +1. Their filters
/// share the sides as differences, with one bound of rounding; exact predicates decide the remaining cases.
inline bool is_convex_quad(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) noexcept {
  const std::array<Vec2, 4> side{b - a, c - b, d - c, a - d};
  bool sure = true;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec2 &e = side[k], &f = side[(k + 1) % 4];
    const double left = e.x() * f.y(), right = e.y() * f.x();
    sure = sure && left - right > detail::orientation_bound * (std::abs(left) + std::abs(right)) + detail::underflow_bound;
  }
  if (sure) return true;
  return orientation(a, b, c) > 0 && orientation(b, c, d) > 0 && orientation(c, d, a) > 0 && orientation(d, a, b) > 0;
}

}  // namespace carreau
