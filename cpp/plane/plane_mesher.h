// SPDX-License-Identifier: BSD-3-Clause
// Unit mesh of a plane domain in a metric field (RR-2928 sec. 2.2).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "control_space/control_space.h"
#include "control_space/sampled_normals.h"
#include "mesh/plane_mesh.h"
#include "support/monitor.h"

namespace carreau {

struct PlaneMesherOptions {
  bool frontal = true;        ///< false: algebraic placement, points on edges longer than unity (RT-0232 `frontal`)
  bool squares = false;       ///< points for quadrilaterals: those of lattices of unit squares; `frontal` says nothing
  bool shape_trials = false;  ///< changes of the mesh around its worst triangles are tried, the best is kept
  /// Of a curved surface, indexed: changes leave no edges along which it turns more than it did along those before, and
  /// add none between two vertices of curves. Null: a plane.
  const SampledNormals* normals = nullptr;
  std::int64_t max_triangles = INT64_C(500'000'000);  ///< LimitError beyond
  /// Squares that another mesh has missed (ControlSpace::undersampled_regions()), as places of each: what is still far
  /// from all vertices when points have been placed gets a seed, from which the front goes on.
  std::span<const std::vector<Vec2>> undersampled = {};
};

/// Triangulates `domain` so that edges have length 1 in the metric as far as possible.
/// Deterministic; re-entrant; no callback but monitor.checkpoint().
/// @throws DomainError   loops that do not close, cross or touch (edges and (u, v) in the message)
/// @throws LimitError, Cancelled
PlaneMesh mesh_plane(const PlaneDomain& domain, const ControlSpace& metric, const PlaneMesherOptions& options,
                     Monitor& monitor);

/// Constrained Delaunay triangulation of the imposed vertices and edges alone, outside removed
/// (the "maillage frontalier" of RR-2928 sec. 2.2), in the metric of (u, v) scaled to the domain's box.
/// Same errors as mesh_plane.
PlaneMesh triangulate_domain(const PlaneDomain& domain, Monitor& monitor);

}  // namespace carreau
