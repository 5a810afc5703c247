// SPDX-License-Identifier: BSD-3-Clause
// Smoothing that does not shrink (HDR sec. 4.7.1).
#pragma once

#include <span>

#include "geometry/grid/grid.h"

namespace carreau::grid {

/// One round of Taubin's filter over the values at regular places of a line: both passes read one array and write the
/// other. Open lines keep their ends; of closed ones all values move. On a closed line of n values mode m is multiplied
/// by (1 - w1 k) (1 + w2 k), with k = 1 - cos(2 pi m / n).
void smooth_line(std::span<double> values, bool closed, const Smoothing& smoothing);

/// Smooths points; each neighbour has the distance of the other neighbour as weight (`moyenne` of HDR sec. 4.7.1).
void smooth_line(std::span<Vec3> points, bool closed, const Smoothing& smoothing);

/// Flags that the first and the last column (or row) of a block have equal points to `tolerance`, and its lines go on
/// smoothly there. Scans always do; other lines turn by less than thresholds::closed_turn in the mean. The trailing
/// edge of a wing stays sharp.
struct Closed {
  bool columns = false;  ///< node (0, j) is node (columns - 1, j)
  bool rows = false;     ///< node (i, 0) is node (i, rows - 1)
};
Closed closed_directions(const Block& block, double tolerance);

/// All rows, then all columns, smoothing.rounds times. Missing nodes end a line. Looks for a stop between rounds.
void smooth_block(Block& block, const Closed& closed, const Smoothing& smoothing, Monitor& monitor);

}  // namespace carreau::grid
