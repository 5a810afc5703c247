// SPDX-License-Identifier: BSD-3-Clause
// Arcs of circles in space, and loops of them on a sphere.
#pragma once

#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include "geometry/molecule/balls.h"

namespace carreau::molecule {

/// centre + radius (cos(t) e1 + sin(t) e2) for t from a to b, or backward.
struct SpaceArc {
  Vec3 centre = {}, e1 = {}, e2 = {};
  double radius = 0, a = 0, b = 0;
  bool backward = false;

  [[nodiscard]] Vec3 point(double t) const { return centre + radius * (std::cos(t) * e1 + std::sin(t) * e2); }
  /// In the direction of the arc.
  [[nodiscard]] Vec3 tangent(double t) const { return (backward ? -1 : 1) * (std::cos(t) * e2 - std::sin(t) * e1); }
  /// About which the arc turns.
  [[nodiscard]] Vec3 axis() const { return backward ? cross(e2, e1) : cross(e1, e2); }
  [[nodiscard]] double first() const { return backward ? b : a; }
  [[nodiscard]] double last() const { return backward ? a : b; }
};

/// The part of a sphere on the left of loops, seen from outside or from inside.
enum class Side { outer, inner };
using SpaceLoop = std::vector<SpaceArc>;

/// Area of one connected part, by the theorem of Gauss and Bonnet.
double area_on_sphere(const Ball& ball, std::span<const SpaceLoop> loops, Side side);
/// Integral of the normal, outward or inward: half the integral of x cross dx along the border.
Vec3 vector_area(const Ball& ball, std::span<const SpaceLoop> loops);

/// Which loops bound one connected part: [loop], the first loop of its part. `bare` returns whether a point of the
/// sphere is in some part.
std::vector<std::size_t> parts_of_loops(const Ball& ball, std::span<const SpaceLoop> loops,
                                        const std::function<bool(const Vec3&)>& bare);

}  // namespace carreau::molecule
