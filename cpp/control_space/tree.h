// SPDX-License-Identifier: BSD-3-Clause
// The cells of a control space under construction. Private to control_space/.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "control_space/control_space.h"
#include "control_space/lattice.h"
#include "support/memory/segmented_array.h"

namespace carreau::detail {

/// [i, i + size] x [j, j + size] in units of the finest grid.
struct TreeCell {
  std::int32_t i = 0, j = 0, size = 0;
  std::int32_t child = -1;                      ///< first of four, -1: a leaf
  std::int32_t block = -1;                      ///< Lattice::block() of its parts' nodes, -1: not yet known
  std::int32_t edges_begin = 0, edges_end = 0;  ///< range of boundary edges that meet the closed cell
  bool relevant = false;                        ///< has points of the domain
  bool tested = false;                          ///< its centre was sampled, or cannot be
  bool filled = false;                          ///< the middles of its sides were sampled for its own sake
  double error = 0;                             ///< of prediction against sample, relative, in length
  double decay = 1;                             ///< of errors from this cell to its parts, about
  double vertices = 0;                          ///< that a mesh would have in the whole cell
  /// In the lattice, row by row: corners, middles of sides, centre.
  std::array<std::int32_t, 9> node{};
  /// Beyond the lower, upper, left, right side: the smallest cell that is not smaller than this cell; -1: no cell.
  std::array<std::int32_t, 4> beside{-1, -1, -1, -1};

  [[nodiscard]] GridPoint point(int k) const noexcept { return {i + (k % 3) * (size / 2), j + (k / 3) * (size / 2)}; }
  [[nodiscard]] std::int32_t centre() const noexcept { return node[4]; }
};
/// Ranks in TreeCell::node: corners; middles of the lower, upper, left, right side; ends of these sides.
inline constexpr int corners_of_cell[4] = {0, 2, 6, 8}, middles_of_sides[4] = {1, 7, 3, 5};
inline constexpr int ends_of_sides[4][2] = {{0, 2}, {6, 8}, {0, 6}, {2, 8}};

/// Square cells over the lattice, each a leaf or split into four.
class Tree {
 public:
  Tree(const SampledDomain& domain, const PolygonLocator& locator, Lattice& lattice);

  [[nodiscard]] std::int32_t size() const noexcept { return static_cast<std::int32_t>(cells_.size()); }
  TreeCell& operator[](std::int32_t cell) noexcept { return cells_[cell]; }
  const TreeCell& operator[](std::int32_t cell) const noexcept { return cells_[cell]; }
  /// Cells that are not children of others, row by row: numbers 0 .. columns() * rows() - 1.
  [[nodiscard]] int columns() const noexcept { return columns_; }
  [[nodiscard]] int rows() const noexcept { return rows_; }
  /// A leaf of size 2 cannot be divided further.
  [[nodiscard]] bool can_split(std::int32_t cell) const noexcept {
    return cells_[cell].child < 0 && cells_[cell].size >= 4;
  }
  void split(std::int32_t cell);
  /// The leaf that holds the unit cell [i, i + 1] x [j, j + 1] of the finest grid; -1 outside of the box.
  [[nodiscard]] std::int32_t leaf_at(GridPoint p) const noexcept;
  /// Searches the leaf in `cell` and its parts.
  [[nodiscard]] std::int32_t leaf_below(std::int32_t cell, GridPoint p) const noexcept;
  /// Boundary vertices in the closed cell, increasing indices in SampledDomain::vertices.
  void vertices_in(const TreeCell& cell, std::vector<int>& found) const;

 private:
  /// `whole`: the place of the whole cell, when it is known.
  [[nodiscard]] Place complete(TreeCell& cell, std::span<const std::int32_t> candidates, Place whole);
  std::int32_t block_of(std::int32_t number);
  std::int32_t block_of(std::int32_t number, int side);
  void join_parts(std::int32_t number);
  void point_to_parts(std::int32_t number, int side);
  [[nodiscard]] bool meets(const TreeCell& cell, std::int32_t edge) const noexcept;

  const SampledDomain& domain_;
  const PolygonLocator& locator_;
  Lattice& lattice_;
  int columns_, rows_;
  SegmentedArray<TreeCell> cells_;
  std::vector<std::int32_t> edges_;
  // Scratch of split() and point_to_parts(), kept for its memory.
  std::vector<std::int32_t> candidates_, todo_;
};

}  // namespace carreau::detail
