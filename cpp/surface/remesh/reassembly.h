// SPDX-License-Identifier: BSD-3-Clause
// From a cross-patch mesh back to faces, curves and (u, v).
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "surface/remesh/base/cross_patch_mesh.h"
#include "surface/remesh/base/sharp_edges.h"
#include "surface/remesh/cells/cell_placer.h"
#include "surface/remesh/division/divided_remeshing.h"
#include "surface/remesh/lines/line_remeshing.h"
#include "surface/result.h"

namespace carreau {

/// The changed data of a mesh that was made free of its patches.
struct CrossPatchResult : SizedMesh {
  // The sources of the mesh, for steps that make other elements.
  std::unique_ptr<CrossPatchMesh> free = {};
  std::vector<WorkedLine> worked = {};  ///< by line
};

/// The line with its remaining vertices; each edge has the curve of the middle one of the edges that it stands for.
SharpLine what_is_left(const SharpLine& line, const std::function<bool(std::int32_t)>& is_there);

/// Cells over a surface. Keeps references.
struct CellsInSpace {
  const PlacedVertices& vertices;
  const Charts& charts;
  Cad& cad;
  std::vector<SpaceCell> cells;  ///< as the atlas is turned
  /// For elements of second order, else empty: by cell the vertices that are the nodes of its sides, from corner k to the next one.
  std::vector<SpaceCell> nodes = {};
};

/// A cell belongs to the face of the closest point of its centroid. Faces without a cell are collapsed. Edges of lines have the curve of
/// the middle one of the edges that they stand for, and curves without an edge have no vertices. Curves that no face has stay as they are,
/// without nodes on their edges. `worked`: by line, the places of its remaining vertices; `workers`: the mesh does not depend on their
/// threads.
SizedMesh reassemble(const SurfaceMesh& before, const CellsInSpace& cells, const std::vector<SharpLine>& lines,
                     std::span<const WorkedLine> worked, const std::vector<std::int32_t>& corners, const RemeshingWorkers& workers,
                     Monitor& monitor);

}  // namespace carreau
