// SPDX-License-Identifier: BSD-3-Clause
// Nodes on the edges of cells of a cross-patch mesh: elements of second order.
#pragma once

#include <array>
#include <vector>

#include "surface/elements/cross_patch/element_cells.h"

namespace carreau {

/// Nodes by cell of ElementCells::quads.
struct EdgeNodes {
  std::vector<SpaceCell> of_cell;  ///< nodes of its sides, from corner k to the next one: vertices of space
  std::size_t moved = 0;          ///< nodes and vertices that repairs have moved
  std::vector<std::int32_t> invalid;  ///< cells whose Jacobian is not positive everywhere, ascending
};

/// Gives each edge a node: on a line its middle, else the surface over the metric middle of its chord, once for both cells. Then repairs
/// elements whose Jacobian is not positive: nodes move along the surface, then vertices. The Jacobian has Bernstein coefficients along the
/// mean normal of the element, which is on the side of the surface. Adds nodes to `vertices`.
EdgeNodes make_nodes(const AtlasSurface& surface, PlacedVertices& vertices, LineMiddles& lines, ElementCells& cells,
                     Monitor& monitor);

/// Improves straight elements with a bad Jacobian in the same way: vertices move.
void mend_straight(const AtlasSurface& surface, const PlacedVertices& vertices, LineMiddles& lines, ElementCells& cells,
                   Monitor& monitor);

}  // namespace carreau
