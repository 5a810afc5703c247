// SPDX-License-Identifier: BSD-3-Clause
// Unit mesh of a plane domain in a metric field (RR-2928 sec. 2.2).
#pragma once

#include "control_space/control_space.h"
#include "mesh/plane_mesh.h"
#include "plane/division/options.h"
#include "support/monitor.h"

namespace carreau {

/// Triangulates `domain` so that edges have lengths near 1 in the metric. Deterministic, for any number of threads;
/// re-entrant; no callback but monitor.checkpoint().
/// @throws DomainError   loops that do not close, cross or touch (edges and (u, v) in the message)
/// @throws LimitError, Cancelled
PlaneMesh mesh_plane(const PlaneDomain& domain, const ControlSpace& metric, const PlaneMesherOptions& options,
                     Monitor& monitor);

/// Constrained Delaunay triangulation of the imposed vertices and edges alone, outside removed (the "maillage
/// frontalier" of RR-2928 sec. 2.2). Its metric is the metric of (u, v) scaled to the domain's box. Same errors as
/// mesh_plane.
PlaneMesh triangulate_domain(const PlaneDomain& domain, Monitor& monitor);

}  // namespace carreau
