// SPDX-License-Identifier: BSD-3-Clause
// The numbers that decide something about grids.
#pragma once

#include <numbers>

namespace carreau::grid::thresholds {

/// ... but never farther than this share of the shortest edge between nodes that differ: cells would vanish. [Glue.*]
inline constexpr double same_node_share_of_edge = 0.1;
/// Turn at the joint of a closed grid (in the mean), or between lines of two blocks, radians. From this turn on the lines do not go on into
/// one another: eight cells make a circle. [Glue.*, Coons.*]
inline constexpr double closed_turn = std::numbers::pi / 4;
/// ... or after so many sweeps: of a hole of 50 x 50 nodes 1e-3 is left. [Holes.*]
inline constexpr int max_sweeps = 2000;
/// Parameter length of a row of cells without extent, as a share of the mean one: parameters must ascend. [Lengths.*]
inline constexpr double min_interval = 1e-3;

}  // namespace carreau::grid::thresholds
