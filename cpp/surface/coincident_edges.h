// Edges of one patch that are one edge in space.
#pragma once

#include "plane/plane_mesh.h"
#include "surface/domain_builder.h"

namespace carreau {

/// Divides inner edges of a patch that join images of the same two vertices of space as another edge of the patch does,
/// or both sides of a seam, until there are none: where a seam or a pole closes a surface, sizes longer than a
/// third of the way round would leave edges of four triangles. Sides of degenerate curves and what lies on curves are
/// left alone. New vertices, in the middle of edges in (u, v), come last. Returns their number.
int divide_coincident_edges(const FaceDomain& domain, PlaneMesh& mesh);

}  // namespace carreau
