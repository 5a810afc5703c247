// SPDX-License-Identifier: BSD-3-Clause
// Characteristic lines of the surface through a grid (HDR sec. 5.2).
#pragma once

#include <vector>

#include "geometry/grid/coons_surface.h"
#include "support/monitor.h"

namespace carreau::grid {

/// Finds lines where the principal curvature of larger absolute value is maximal along its own direction, and the radius of curvature is below
/// `radius` (model length). Each line is a polyline on the surface, of places where edges of triangles of the grid cross it; its error is of order
/// two. Closed lines end at their first place. Lines that are shorter than `radius`, lines of constant curvature, and lines along the border of the grid are left out.
std::vector<std::vector<Vec3>> find_ridges(const CoonsSurface& surface, double radius, Monitor& monitor);

}  // namespace carreau::grid
