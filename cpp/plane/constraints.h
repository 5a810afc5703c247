// Triangulation of the imposed vertices and edges, outside removed.
#pragma once

#include "plane/plane_mesh.h"
#include "plane/triangulation.h"
#include "support/monitor.h"

namespace carreau::plane {

/// Constrained triangulation of `domain`: vertices keep their order, imposed edges carry their bits, triangles outside
/// are gone. Throws DomainError.
Triangulation triangulate(const PlaneDomain& domain, Monitor& monitor);

}  // namespace carreau::plane
