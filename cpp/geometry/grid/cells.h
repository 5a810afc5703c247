// SPDX-License-Identifier: BSD-3-Clause
// The cells of a block, their connections, and their borders.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/grid/grid.h"

namespace carreau::grid {

/// A side of a cell on the border of its region, the region on its left in (u, v).
struct BorderEdge {
  int i = 0, j = 0;  ///< the cell
  int side = 0;      ///< 0: below, 1: right, 2: above, 3: left

  [[nodiscard]] bool along_u() const { return side % 2 == 0; }
  /// Runs with growing parameters.
  [[nodiscard]] bool forward() const { return side < 2; }
  struct NodeAt {
    int i, j;
  };
  [[nodiscard]] NodeAt start() const;
  [[nodiscard]] NodeAt end() const;
  /// The nodes of the cell that are not on the edge, behind start() and behind end().
  [[nodiscard]] NodeAt inner_start() const;
  [[nodiscard]] NodeAt inner_end() const;
  /// Rank of the row or column of cells that the edge belongs to: i along u, j along v.
  [[nodiscard]] int interval() const { return along_u() ? i : j; }
};

/// Cells that touch by sides, and the loops around them.
struct Region {
  std::vector<std::vector<BorderEdge>> loops;  ///< the outer one and holes, in no order
};

struct Cells {
  std::vector<Region> regions;  ///< by their first cell
  std::vector<char> there;      ///< [node at the lower left of a cell]
  std::size_t count = 0;        ///< of cells
  std::size_t missing = 0;      ///< cells without all four nodes
  std::size_t flat = 0;         ///< cells without area, which are left out
  std::size_t folded = 0;       ///< cells whose corners do not turn the same way
  int folded_i = 0, folded_j = 0, flat_i = 0, flat_j = 0;  ///< the first of each, from 0
};

Cells find_cells(const Block& block);

}  // namespace carreau::grid
