// SPDX-License-Identifier: BSD-3-Clause
// Degenerate sides (HDR sec. 4.5.4): an edge of the parameter plane that is one point in space, the apex. The metric
// near it is clamped, so that fronts and the kernel are unreliable there. The fan of triangles that surrounds the apex
// is built first, and never changed again.
#pragma once

#include "mesh/plane_mesh.h"
#include "plane/placement/insertion.h"

namespace carreau::plane {

/// Surrounds each degenerate edge of the domain by a fan of triangles of unit height (PlaneEdge::min_fan, wide_fan),
/// imposed and frozen. Its vertices must not move from now on.
void surround_degenerate_sides(Placement& placement, const PlaneDomain& domain);

}  // namespace carreau::plane
