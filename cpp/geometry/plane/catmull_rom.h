// SPDX-License-Identifier: BSD-3-Clause
// Splines of Catmull and Rom through points of the plane (RR-2818 sec. 3.2).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/plane/cubic_piece.h"

namespace carreau {

/// Conditions beyond the ends of a spline. Each end has at most one; none: the end is free.
struct SplineEnds {
  std::optional<Vec2> before, after;               ///< control points P1 and Pn, which the spline does not pass
  std::optional<Vec2> tangent_start, tangent_end;  ///< derivatives there, along the curve's direction
};

/// The n - 1 pieces of the spline through n >= 2 `points`. Its tangent at a point is half the vector from the previous
/// to the next point. When the first point is the last one and neither end is given, the spline wraps round.
std::vector<CubicPiece> catmull_rom(std::span<const Vec2> points, const SplineEnds& ends);

/// The same pieces as segments.
std::vector<CubicPiece> straight_pieces(std::span<const Vec2> points);

}  // namespace carreau
