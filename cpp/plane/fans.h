// Fans around degenerate sides.
#pragma once

#include "plane/plane_mesh.h"
#include "size/control_space.h"

namespace carreau::plane {

/// The domain with a row of vertices, joined by internal edges, across each degenerate side, from the first vertex on one of its
/// neighbours to the first on the other: in space a ring around one point (HDR sec. 4.5.4). The ring has as many edges as its metric length asks for,
/// and at least PlaneEdge::least_fan. Where it would meet the boundary or come too near to the side there is none. New vertices follow those of `domain`.
PlaneDomain with_fans(const PlaneDomain& domain, const ControlSpace& space);

}  // namespace carreau::plane
