// SPDX-License-Identifier: BSD-3-Clause
// An arc of a circle of the plane, f(t) = c + r (cos(a + s t), sin(a + s t)) on [0, 1].
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "support/vec.h"

namespace carreau {

/// Lengths are in the plane's unit, angles are in radians; t has no unit. Its curvature is 1 / radius, to the left when the sweep is
/// positive.
struct CirclePiece {
  Vec2 centre;
  double radius = 0;
  double start = 0;  ///< angle at t = 0
  double sweep = 0;  ///< angle from end to end, counterclockwise when positive; at most 2 pi either way

  [[nodiscard]] Vec2 at(double t) const noexcept;
  [[nodiscard]] Vec2 first(double t) const noexcept;
  [[nodiscard]] Vec2 second(double t) const noexcept;
};

/// The arc from a to b that passes m on its way; when a and b are one point, the circle with the diameter a m,
/// counterclockwise. Empty when three different points lie on a line.
std::optional<CirclePiece> arc_through(const Vec2& a, const Vec2& m, const Vec2& b) noexcept;

/// The parts of arc_through(a, m, b) from a to m and from m to b.
std::pair<CirclePiece, CirclePiece> cut_at(const CirclePiece& arc, const Vec2& m) noexcept;

/// Parameters strictly inside (0, 1), ascending, of a polyline of equal edges. An edge of length d has the arc within
/// eps d, and turns by a right angle at most. eps > 0, else InvalidArgument.
std::vector<double> subdivide(const CirclePiece& piece, double eps);

}  // namespace carreau
