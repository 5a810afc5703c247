// SPDX-License-Identifier: BSD-3-Clause
// Edges on the borders of blocks that are one in space, and the curves that they form.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "geometry/grid/cells.h"

namespace carreau::grid {

/// A region of a block: a face of the model.
struct FaceRegion {
  int block = 0, region = 0;
};

/// One appearance of an edge.
struct EdgeUse {
  int face = 0;  ///< index in Borders::faces
  BorderEdge edge;
};

/// Part of the border of a face that is one curve: edges in the direction of the loop.
struct Chain {
  std::vector<BorderEdge> edges;
  int curve = 0;              ///< reference
  int start = 0, end = 0;     ///< references of points
  bool point = false;         ///< all of it is one point of space
};

struct Borders {
  std::vector<FaceRegion> faces;
  std::vector<std::vector<Chain>> chains;  ///< [face]
  /// Edges by the points at their ends, the smaller one first, with all their uses. Edges of one point are left out.
  std::map<std::pair<int, int>, std::vector<EdgeUse>> edges;
  std::vector<std::vector<int>> point_of;  ///< [block][node]: reference from 1; 0: not on a border

  [[nodiscard]] int point(int block, const Block& nodes, const BorderEdge::NodeAt& at) const {
    return point_of[static_cast<std::size_t>(block)][nodes.index(at.i, at.j)];
  }
};

/// Nodes of borders nearer than `tolerance` become one: all get the place of the first of them. Throws InvalidModel
/// when two blocks have a cell in common.
Borders find_borders(std::vector<Block>& blocks, const std::vector<Cells>& cells, double tolerance);

}  // namespace carreau::grid
