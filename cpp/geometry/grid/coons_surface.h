// SPDX-License-Identifier: BSD-3-Clause
// A surface that is bicubic on each cell of a grid and at least C1 between cells (HDR sec. 4.7.2).
#pragma once

#include <vector>

#include "cad/cad.h"

namespace carreau::grid {

/// A node with the derivatives that the cells around it share (HDR eq. 4.87-4.89).
struct Node {
  Vec3 s, su, sv, suv;
};

/// Nodes lie at (u[i], v[j]); both ascend. nodes[i + u.size() * j].
struct CoonsSurface {
  std::vector<double> u, v;
  std::vector<Node> nodes;
  std::vector<char> cells = {};  ///< [i + u.size() * j]: whether the cell from node (i, j) on is there; empty: all are

  [[nodiscard]] const Node& node(std::size_t i, std::size_t j) const { return nodes[i + u.size() * j]; }
  Node& node(std::size_t i, std::size_t j) { return nodes[i + u.size() * j]; }
  /// All derivatives to order two. Derivatives of second order may jump between cells; on a line between cells they belong
  /// to the cell above and to the right. Outside of the cells that are there the nearest one goes on (HDR eq. 4.90,
  /// 4.91); NaN without a neighbouring cell.
  [[nodiscard]] SurfaceJet at(const Vec2& uv) const;
  [[nodiscard]] bool has_cell(std::size_t i, std::size_t j) const { return cells.empty() || cells[i + u.size() * j] != 0; }
};

}  // namespace carreau::grid
