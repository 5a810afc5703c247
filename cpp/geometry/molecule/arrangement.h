// SPDX-License-Identifier: BSD-3-Clause
// Exposed parts of spheres: circles, vertices, arcs and components (HDR sec. 4.6.2).
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "geometry/molecule/space_arc.h"
#include "support/monitor.h"

namespace carreau::molecule {

/// The circle in which the spheres of balls i < j cross. Its points are centre + radius (cos(a) e1 + sin(a) e2); e1,
/// e2, axis are right-handed, and the axis points from ball i to ball j.
struct Circle {
  int i = 0, j = 0;
  Vec3 centre = {}, axis = {}, e1 = {}, e2 = {};
  double radius = 0;
  double offset_i = 0;  ///< of the plane from the centre of ball i, along the axis
  double offset_j = 0;  ///< from the centre of ball j, against the axis

  [[nodiscard]] Vec3 point(double angle) const {
    return centre + radius * (std::cos(angle) * e1 + std::sin(angle) * e2);
  }
  [[nodiscard]] Vec3 tangent(double angle) const { return std::cos(angle) * e2 - std::sin(angle) * e1; }
  /// In [0, 2 pi[.
  [[nodiscard]] double angle(const Vec3& p) const;
  [[nodiscard]] double offset(int ball) const { return ball == i ? offset_i : offset_j; }
};

/// A point of three spheres that no ball covers; the balls ascend.
struct Vertex {
  std::array<int, 3> balls{};
  Vec3 x;
};

/// A part of a circle that no ball covers, from angle a to angle b > a.
struct Arc {
  int circle = 0;
  int start = -1, end = -1;  ///< vertices; -1: the whole circle
  double a = 0, b = 0;
  /// True if the arc is at most a millionth of the smaller radius long: a model has a point in its place. Arcs of small
  /// loops with a longer arc are never tiny.
  bool tiny = false;

  [[nodiscard]] bool whole() const { return start < 0; }
};

/// An arc as the boundary of a ball's exposed part, which lies on its left seen from outside. It is forward for ball j
/// of its circle, backward for ball i.
struct ArcUse {
  int arc = 0;
  bool forward = true;
};
using Loop = std::vector<ArcUse>;

/// A connected part of a sphere that no other ball covers. No loop: the whole sphere.
struct Component {
  int ball = 0;
  std::vector<Loop> loops = {};
};

struct Arrangement {
  std::vector<Ball> balls;   ///< as given, except for moved radii
  std::vector<int> held_by;  ///< [ball]: the ball that holds it; -1: none
  std::vector<int> moved;    ///< balls whose radius was moved, ascending
  std::vector<Circle> circles;
  std::vector<Vertex> vertices;
  std::vector<Arc> arcs;
  std::vector<Component> components;  ///< by ball
  std::size_t meeting_pairs = 0;

  [[nodiscard]] const Circle& circle_of(const ArcUse& use) const { return circles[arcs[use.arc].circle]; }
  [[nodiscard]] SpaceArc space_arc(const ArcUse& use) const {
    const Circle& c = circle_of(use);
    return {c.centre, c.e1, c.e2, c.radius, arcs[use.arc].a, arcs[use.arc].b, !use.forward};
  }
  [[nodiscard]] SpaceLoop space_loop(const Loop& loop) const;
  /// Euler number of the union's boundary, from its components, arcs and vertices.
  [[nodiscard]] int euler_number() const;
};

/// Linear memory; n log n for balls of similar radii of which few meet at a time. Rounding may leave a decision open
/// (four spheres through one point, three through a touching one). Then the radii of its balls are moved by some 1e-9
/// of themselves, by a rule of their ranks alone. All decisions are then repeated, so that they belong to one set of
/// balls. Throws as check_balls(), and InvalidArgument when eight such rounds fail. The result does not depend on the
/// number of threads.
Arrangement arrange(std::span<const Ball> balls, int threads, Monitor& monitor);

}  // namespace carreau::molecule
