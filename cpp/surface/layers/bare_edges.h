// SPDX-License-Identifier: BSD-3-Clause
// Edges of curves with layers that have no row.
#pragma once

#include <span>
#include <vector>

#include "mesh/layer_cell.h"
#include "mesh/surface_mesh.h"
#include "surface/layers/layer_curves.h"

namespace carreau {

/// Sides of edges: an edge counts for each face, and twice inside a face.
struct BareEdges {
  /// The bare ones of a curve on a face, by their references.
  struct OfCurve {
    int curve = 0, face = 0;
    std::int64_t bare = 0;
  };
  std::int64_t sides = 0, bare = 0;
  std::vector<OfCurve> curves;  ///< with a bare side, in the order of the mesh
};

/// Counts the sides of edges without a cell, for each set of layers. `cells`: by face.
std::vector<BareEdges> find_bare_edges(const SurfaceMesh& mesh, const std::vector<std::vector<LayerCell>>& cells,
                                       std::span<const CurveLayers> layers);

}  // namespace carreau
