// SPDX-License-Identifier: BSD-3-Clause
// Vertices moved for the shapes of triangles in space, after the lift.
#pragma once

#include "surface/improve/bad_region.h"
#include "surface/patch.h"

namespace carreau {

/// Moves vertices of the region if the move raises the worst shape quality of the triangles around, and one of these is
/// bad. At a pole, or if a metric changes much within an edge, triangles with good shapes in the parameter plane may be
/// bad in space. Triangles stay counterclockwise in (u, v), exactly, and none turns away from the surface. Evaluates
/// the surface at and around such vertices only. Returns the vertices that have moved, some more than once.
std::vector<std::int32_t> smooth_in_space(const BadRegion& region, const PlaneDomain& domain, int ref, Cad& cad,
                                          PatchMesh& mesh, Monitor& monitor);

}  // namespace carreau
