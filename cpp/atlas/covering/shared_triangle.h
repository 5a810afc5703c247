// SPDX-License-Identifier: BSD-3-Clause
// The triangle T on which three regions meet (Atlas sec. 5.5.1.2): equilateral, of side 1, a region at each corner.
#pragma once

#include <numbers>

#include "atlas/jet.h"

namespace carreau::atlas {

inline constexpr double sixth_turn = std::numbers::pi / 3;

/// Polar coordinates about a corner: phi is 0 along the side to the next corner and pi / 3 along the other one.
template <typename Number>
struct Polar {
  Number l, phi;
};

/// Radius of the pure zone in each corner.
inline constexpr double inner_length = std::numbers::sqrt3 / 4;

/// The outer end of the region of a corner. Even in phi about each side, so that it is C1 where triangles T share one.
template <typename Number>
Number outer_length(const Number& phi) {
  using std::cos, std::sqrt;
  const double x = value_of(phi);
  const double turns = std::floor(x / sixth_turn);
  Number p = phi - turns * sixth_turn;
  if (value_of(p) > sixth_turn / 2) p = sixth_turn - p;
  const double first = std::atan(std::numbers::sqrt3 / 5);
  if (value_of(p) <= first) {  // the circle about the next corner
    const Number c = cos(p);
    return c - sqrt(c * c - 13.0 / 16);
  }
  const Number c =
      cos(std::numbers::pi / 6 - p) / std::numbers::sqrt3;  // the circle of radius sqrt(3) / 12 about the centre
  return c + sqrt(c * c - 5.0 / 16);
}

/// Share of the way between both borders of a region.
template <typename Number>
Number share_of(const Polar<Number>& at) {
  return (at.l - inner_length) / (outer_length(at.phi) - inner_length);
}
template <typename Number>
Polar<Number> polar_at(const Number& share, const Number& phi) {
  return {inner_length + share * (outer_length(phi) - inner_length), phi};
}

inline Vec2 corner_of_t(int corner) {
  return corner == 0 ? Vec2(0, 0) : (corner == 1 ? Vec2(1, 0) : Vec2(.5, std::numbers::sqrt3 / 2));
}
/// Direction of the side to the next corner.
inline Vec2 side_of_t(int corner) { return corner_of_t((corner + 1) % 3) - corner_of_t(corner); }

template <typename Number>
Pair<Number> from_polar(int corner, const Polar<Number>& at) {
  using std::cos, std::sin;
  const Vec2 c = corner_of_t(corner), e = side_of_t(corner);
  const Number x = at.l * cos(at.phi), y = at.l * sin(at.phi);
  return {c.x() + e.x() * x - e.y() * y, c.y() + e.y() * x + e.x() * y};
}
template <typename Number>
Polar<Number> to_polar(int corner, const Pair<Number>& p) {
  using std::atan2, std::sqrt;
  const Vec2 c = corner_of_t(corner), e = side_of_t(corner);
  const Number dx = p[0] - c.x(), dy = p[1] - c.y();
  const Number x = e.x() * dx + e.y() * dy, y = e.x() * dy - e.y() * dx;
  return {sqrt(x * x + y * y), atan2(y, x)};
}

}  // namespace carreau::atlas
