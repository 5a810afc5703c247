// SPDX-License-Identifier: BSD-3-Clause
// Edge swaps judged in space, after the lift.
#pragma once

#include "support/monitor.h"
#include "surface/improve/bad_region.h"

namespace carreau {

/// Swaps edges of the region that are not imposed, if one of the two triangles is poor and the swap raises the worse
/// shape quality. Triangles stay counterclockwise in (u, v), exactly. No vertex moves, no callback. Returns whether an
/// edge was swapped.
bool swap_in_space(const BadRegion& region, const PlaneDomain& domain, PlaneMesh& mesh, std::vector<Vec3>& xyz,
                   Monitor& monitor);

}  // namespace carreau
