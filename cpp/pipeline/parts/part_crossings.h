// SPDX-License-Identifier: BSD-3-Clause
// Triangles that cross in a mesh that several processes keep in parts. Private to pipeline/.
#pragma once

#include <cstddef>

#include "mesh/crossings/intersections.h"
#include "pipeline/base/run.h"

namespace carreau {

/// The pairs of the whole mesh, the same in all processes.
struct PartCrossings {
  /// Vertices of all curves, the curves, and of each face the triangles of `found.pairs` in their order, with (u, v). Faces have the
  /// vertices of their curves, too.
  SurfaceMesh mesh;
  Intersections found;  ///< triangles are numbered in `mesh`, face after face
};

/// Each process looks for crossings between its own triangles, and between these and near triangles of other processes. Boxes of some
/// hundred triangles reach all processes, and then the triangles in boxes of two processes. `limit`: of Intersections::pairs. All
/// processes call it.
PartCrossings find_part_crossings(const CompositeRun& run, std::size_t limit);

}  // namespace carreau
