// SPDX-License-Identifier: BSD-3-Clause
// Directions from which a triangle is visible. Private to mesh/.
#pragma once

#include <cmath>
#include <cstdint>

#include "predicates/predicates.h"
#include "support/vec.h"

namespace carreau {

/// A view along an axis, which keeps orders of rotation.
inline Vec2 along(int axis, const Vec3& p) noexcept {
  return axis == 0 ? Vec2{p.y(), p.z()} : axis == 1 ? Vec2{p.z(), p.x()} : Vec2{p.x(), p.y()};
}

/// The orientation of a triangle, seen along an axis. Exact.
inline int turn(int axis, const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  return orientation(along(axis, a), along(axis, b), along(axis, c));
}

/// Share of a normal that lies along an axis along which a triangle is well seen, squared: up to 60 degrees. The largest
/// of three is .577 and more. [time only]
inline constexpr double min_along_squared = 0.25;

/// The six ways along the axes are sides: 2 axis if the triangle is turned counterclockwise, 2 axis + 1 clockwise.
struct TriangleView {
  static constexpr std::int8_t none = -1;

  std::int8_t side = none; ///< exact: seen along the axis of the largest area if doubles can decide; none: no area
  std::uint8_t good = 0;   ///< bits of the sides from which it is well seen, by doubles

  [[nodiscard]] bool any() const noexcept { return side != none; }
  [[nodiscard]] int axis() const noexcept { return side >> 1; }
  [[nodiscard]] int turned() const noexcept { return 1 - 2 * (side & 1); }
  [[nodiscard]] bool is_good(std::int8_t from) const noexcept { return (good >> from & 1) != 0; }
};

inline TriangleView view_of(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  const Vec3 n = cross(b - a, c - a);
  const double x = std::abs(n.x()), y = std::abs(n.y()), z = std::abs(n.z());
  const int best = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  TriangleView view;
  for (int k = 0; k < 3 && !view.any(); ++k) {
    const int axis = best + k < 3 ? best + k : best + k - 3;
    if (const int sign = turn(axis, a, b, c); sign != 0) view.side = static_cast<std::int8_t>(2 * axis + (sign < 0));
  }
  const double least = min_along_squared * (x * x + y * y + z * z);
  const auto bit = [&](int axis, double share) { return (share * share > least) << (2 * axis + (n[axis] < 0)); };
  view.good = static_cast<std::uint8_t>(bit(0, x) | bit(1, y) | bit(2, z));
  return view;
}

}  // namespace carreau
