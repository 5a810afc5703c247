// SPDX-License-Identifier: BSD-3-Clause
// Structured grids of points as geometry (HDR sec. 4.7).
#pragma once

#include <string>
#include <vector>

#include "geometry/built_geometry.h"
#include "support/monitor.h"

namespace carreau::grid {

/// Coordinates that the instrument measured: smoothing moves them.
enum class Measured {
  points,   ///< all coordinates
  heights,  ///< z, at regular x and y
  radii     ///< the distance from the axis z, at regular angles and heights
};

/// The nodes of one grid. Node (i, j) is nodes[i + columns * j]; one with a coordinate that is NaN is missing.
struct Block {
  int columns = 0, rows = 0;  ///< at least 2
  std::vector<Vec3> nodes;
  std::string name = {};  ///< for messages; may be empty
  Measured measured = Measured::points;
  int line = 0;  ///< of the file it was read from; 0: from memory

  [[nodiscard]] std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(i) + static_cast<std::size_t>(columns) * static_cast<std::size_t>(j);
  }
  [[nodiscard]] const Vec3& node(int i, int j) const { return nodes[index(i, j)]; }
  [[nodiscard]] bool has(int i, int j) const { return is_finite(node(i, j)); }
  /// Returns whether all four nodes of the cell from (i, j) to (i + 1, j + 1) are there.
  [[nodiscard]] bool has_cell(int i, int j) const {
    return has(i, j) && has(i + 1, j) && has(i, j + 1) && has(i + 1, j + 1);
  }
  /// Returns "block 3, cell (2, 5)": numbers from 1.
  [[nodiscard]] static std::string place(std::size_t block, int i, int j);
};

struct Grid {
  std::vector<Block> blocks;
  std::string source;  ///< name of the file; empty: from memory
};

/// Taubin's filter (HDR sec. 4.7.1).
struct Smoothing {
  int rounds = 0;       ///< 0: nodes stay as they are
  double inward = 0.06;   ///< w1 of HDR sec. 4.7.1
  double outward = 0.061;  ///< w2, a little larger
  /// Neighbours of heights and radii weigh by the other one's distance in space, as the paper has it; false: evenly.
  bool by_distance = false;
};

struct Options {
  Smoothing smoothing{};
  /// Parameters are cumulated mean lengths of edges (HDR sec. 4.7.3) instead of integers.
  bool lengths = false;
  /// Blocks whose normals differ by less than this (radians) along a common border get one tangent plane there. 0: each
  /// block has its own derivatives, and they meet with G0.
  double join_angle = 0;
  /// Nodes on borders are one when they are nearer than this (model length); 0: a millionth of the diagonal.
  double tolerance = 0;
  /// Holes that no side of a block touches are filled first, and a message reports the number of nodes.
  bool fill = false;
  /// Blocks are turned over, by running their columns backwards, so that normals agree across common borders. The first
  /// block stays; where blocks enclose a volume normals point outwards. No message reports this.
  bool orient = false;
  /// Derivatives at nodes are derivatives of cubic splines: second derivatives are continuous between cells, except beside missing nodes, where
  /// borders of blocks match over a part of their length, and near points where four joined blocks meet.
  bool splines = false;
  bool cross_derivatives = true;  ///< false: zero as in Ferguson's patches, which flatten (HDR sec. 4.7.2); for comparisons
};

struct GridGeometry {
  BuiltGeometry built;
  std::vector<std::string> warnings;
};

/// Smooths the nodes, then interpolates each block by bicubic Coons patches with C1 or C2 between cells (HDR eq. 4.87-4.91).
/// The reference of a face is the rank of its block, from 1. Cells without all four nodes are left out. If they cut a
/// block in two, the other parts have references behind all blocks, results have the block's reference (Face::part_of),
/// and a warning reports it. Nodes of borders that are one within the tolerance are glued, also the two sides of one
/// block; sides that are one point are degenerate curves. A closed block is differenced across its joint.
///
/// Throws InvalidArgument or InvalidModel, naming block and node from 1, and the line of the file. Causes are: less than two rows or
/// columns; infinite coordinates; no cell at all; a cell that is a line; two blocks with a cell in common. Cells that fold are warned of.
GridGeometry build_grid_geometry(const Grid& grid, const Options& options, Monitor& monitor);

}  // namespace carreau::grid
