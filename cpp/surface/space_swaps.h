// Edge swaps judged in space, after the lift.
#pragma once

#include <vector>

#include "plane/plane_mesh.h"

namespace carreau {

/// Swaps edges that are not imposed while that raises the worse shape quality (Q2, HDR eq. 1.6, in space) of the two
/// triangles, where one of them is bad. Triangles stay counterclockwise in (u, v), exactly. No vertex moves, no
/// callback.
void improve_in_space(const PlaneDomain& domain, PlaneMesh& mesh, const std::vector<Vec3>& xyz);

}  // namespace carreau
