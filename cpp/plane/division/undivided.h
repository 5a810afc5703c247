// SPDX-License-Identifier: BSD-3-Clause
// Unit mesh of a domain, or of a piece of one, in one go.
#pragma once

#include "control_space/control_space.h"
#include "mesh/plane_mesh.h"
#include "plane/division/options.h"
#include "plane/kernel/boundary.h"
#include "plane/kernel/frame.h"
#include "plane/kernel/triangulation.h"
#include "support/monitor.h"

namespace carreau::plane {

struct UndividedMesh {
  PlaneMesh mesh;
  int fixed = 0;  ///< the first vertices: imposed vertices, and vertices of the fans of degenerate sides
};

/// The state of the mesher, with neighbours. Triangles and vertices that are removed are still there.
struct UndividedWork {
  BoundaryMesh framed;
  int fixed = 0;
};
enum class Improve : bool { no, yes };  ///< no: swaps and moves are left to the caller
UndividedWork work_undivided(const PlaneDomain& domain, const ControlSpace& metric, Field::Known known,
                             const PlaneMesherOptions& options, Improve improve, Monitor& monitor);

/// As mesh_plane(), by one thread. `known`: of the metric in the domain.
UndividedMesh mesh_undivided(const PlaneDomain& domain, const ControlSpace& metric, Field::Known known,
                             const PlaneMesherOptions& options, Monitor& monitor);

/// Like mesh_undivided(), without the improvement.
UndividedMesh place_undivided(const PlaneDomain& domain, const ControlSpace& metric, Field::Known known,
                              const PlaneMesherOptions& options, Monitor& monitor);

/// A triangulation of a frame as a mesh outside of the frame. The mesh has the domain's vertices.
PlaneMesh to_mesh(const PlaneDomain& domain, const Triangulation& triangulation, const Frame& frame);

}  // namespace carreau::plane
