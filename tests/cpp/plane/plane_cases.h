// SPDX-License-Identifier: BSD-3-Clause
// Parametric patches in closed form, with their unit boundaries, for the tests and the benchmark of the plane mesher.
// Sizes are prescribed edge lengths in space.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "control_space/control_space.h"
#include "mesh/plane_mesh.h"

namespace carreau::testing {

struct PlaneCase {
  std::string name;
  std::function<Vec3(Vec2)> surface;
  std::function<double(Vec2)> size;
  PlaneDomain domain;
  Vec2 low, high;  ///< box in which differences may be taken
};

/// First fundamental form over the squared size, by central differences of the surface.
Metric2 true_metric(const PlaneCase& c, Vec2 uv);
ControlSpace control_space(const PlaneCase& c, double tolerance = 0.02);

/// Appends to `domain` the unit subdivision of a curve that is closed (`closed`) or starts at the vertex
/// `start` (-1: at a new one) and ends at the vertex `end` (-1: at a new one). Returns the last vertex.
int append_curve(PlaneCase& c, const std::function<Vec2(double)>& curve, PlaneEdgeKind kind, int start, int end);
int append_closed_curve(PlaneCase& c, const std::function<Vec2(double)>& curve);
/// Closed polygon with unit edges in between.
void append_polygon(PlaneCase& c, const std::vector<Vec2>& corners);

PlaneCase flat_square(double h);
PlaneCase paraboloid(double h);               ///< z = (u^2 + v^2) / 2 on [-2.5, 2.5]^2
PlaneCase hemisphere(double h);               ///< stereographic, unit disc
PlaneCase torus_patch(double h);              ///< half a turn by half a turn, radii 2 and 1
PlaneCase swirl(double h, double turns = 4);  ///< isometric up to a shear that turns with the radius
PlaneCase stretched(double h);                ///< box 1 by 50, cubic and sheared
PlaneCase size_field(double h);               ///< sizes h .. 10 h, slope 0.26, around a circle
PlaneCase holes(double h);                    ///< square with five holes and a thin slit
PlaneCase star(double h);                     ///< ten sharp corners and a hole
PlaneCase internal_curves(double h);          ///< a cross, a free curve and points inside a square
PlaneCase polar_disc(double h);               ///< (radius, angle), the side radius = 0 is one point, the others a seam
PlaneCase polar_cone(double h, double half_angle);
PlaneCase sphere_two_poles(double h);  ///< longitude and latitude, two degenerate sides

}  // namespace carreau::testing
