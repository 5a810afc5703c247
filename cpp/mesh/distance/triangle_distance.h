// SPDX-License-Identifier: BSD-3-Clause
// Distance from a point to a triangle of space.
#pragma once

#include <algorithm>

#include "support/segment.h"

namespace carreau {

/// Distance from p to the closed triangle (a, b, c); of a flat one, to its sides.
inline double distance_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  const Vec3 normal = cross(b - a, c - a);
  const bool inside = dot(cross(b - a, p - a), normal) >= 0 && dot(cross(c - b, p - b), normal) >= 0 &&
                      dot(cross(a - c, p - c), normal) >= 0;
  const double area = norm(normal);
  if (inside && area > 0) return std::abs(dot(p - a, normal)) / area;
  return std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
}

}  // namespace carreau
