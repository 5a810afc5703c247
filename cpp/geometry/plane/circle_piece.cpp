// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/plane/circle_piece.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "support/error.h"

namespace carreau {

namespace {

constexpr double turn = 2 * std::numbers::pi;

double angle_of(const Vec2& d) noexcept { return std::atan2(d.y(), d.x()); }

/// Angle in (0, 2 pi] counterclockwise, or in [-2 pi, 0).
double swept(double from, double to, bool counterclockwise) noexcept {
  double angle = std::fmod(to - from, turn);
  if (counterclockwise && angle <= 0) angle += turn;
  if (!counterclockwise && angle >= 0) angle -= turn;
  return angle;
}

}  // namespace

Vec2 CirclePiece::at(double t) const noexcept {
  const double angle = start + sweep * t;
  return centre + radius * Vec2{std::cos(angle), std::sin(angle)};
}

Vec2 CirclePiece::first(double t) const noexcept {
  const double angle = start + sweep * t;
  return radius * sweep * Vec2{-std::sin(angle), std::cos(angle)};
}

Vec2 CirclePiece::second(double t) const noexcept {
  const double angle = start + sweep * t;
  return -radius * sweep * sweep * Vec2{std::cos(angle), std::sin(angle)};
}

std::optional<CirclePiece> arc_through(const Vec2& a, const Vec2& m, const Vec2& b) noexcept {
  const Vec2 p = m - a, q = b - a;
  if (a == b) {
    const Vec2 centre = a + 0.5 * p;
    return CirclePiece{centre, norm(p) / 2, angle_of(a - centre), turn};
  }
  // The centre relative to a: as far from m and b as from a.
  const double twice_area = cross(p, q), p2 = dot(p, p), q2 = dot(q, q);
  const Vec2 to_centre = Vec2{q.y() * p2 - p.y() * q2, p.x() * q2 - q.x() * p2} / (2 * twice_area);
  if (twice_area == 0 || !is_finite(to_centre)) return std::nullopt;
  const Vec2 centre = a + to_centre;
  const double start = angle_of(-to_centre);
  return CirclePiece{centre, norm(to_centre), start, swept(start, angle_of(q - to_centre), twice_area > 0)};
}

std::pair<CirclePiece, CirclePiece> cut_at(const CirclePiece& arc, const Vec2& m) noexcept {
  const double to_m = swept(arc.start, angle_of(m - arc.centre), arc.sweep > 0);
  return {{arc.centre, arc.radius, arc.start, to_m},
          {arc.centre, arc.radius, arc.start + to_m, arc.sweep - to_m}};
}

std::vector<double> subdivide(const CirclePiece& piece, double eps) {
  if (!(eps > 0)) throw InvalidArgument("the tolerance of a subdivision must be positive");
  // An edge that sweeps s has the height d tan(s / 4) / 2.
  const double most = std::min(4 * std::atan(2 * eps), std::numbers::pi / 2);
  const auto parts = static_cast<int>(std::ceil(std::abs(piece.sweep) / most));
  std::vector<double> cuts;
  for (int i = 1; i < parts; ++i) cuts.push_back(static_cast<double>(i) / parts);
  return cuts;
}

}  // namespace carreau
