// SPDX-License-Identifier: BSD-3-Clause
// Triangulation of the imposed vertices and edges, outside removed ("maillage frontalier", RR-2928 sec. 2.2).
#pragma once

#include "mesh/plane_mesh.h"
#include "plane/kernel/frame.h"
#include "plane/kernel/triangulation.h"
#include "support/monitor.h"

namespace carreau::plane {

struct BoundaryMesh {
  Frame frame;
  Triangulation mesh;  ///< in the frame; the domain's vertices in their order, imposed edges marked
};

/// Constrained Delaunay triangulation in the frame. Throws DomainError, LimitError, Cancelled.
BoundaryMesh triangulate_boundary(const PlaneDomain& domain, Monitor& monitor);

}  // namespace carreau::plane
