// SPDX-License-Identifier: BSD-3-Clause
// Vertices moved for the shapes of triangles in space, after the lift.
#pragma once

#include "surface/improve/bad_region.h"
#include "surface/patch.h"

namespace carreau {

/// Moves vertices of the region where that raises the worst shape quality of the triangles around, if one of these is
/// bad: at a pole, and where a metric changes much within an edge, what is well shaped in the parameter plane need not
/// be so in space. Triangles stay counterclockwise in (u, v), exactly, and none turns away from the surface. Asks the
/// host for the surface at and around such vertices only. Returns those that have moved, some more than once.
std::vector<std::int32_t> smooth_in_space(const BadRegion& region, const PlaneDomain& domain, int ref, Cad& cad,
                                          PatchMesh& mesh, Monitor& monitor);

}  // namespace carreau
