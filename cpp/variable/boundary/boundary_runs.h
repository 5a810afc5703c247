// SPDX-License-Identifier: BSD-3-Clause
// Runs of the boundary between its corners (HDR sec. 3.4.2).
#pragma once

#include <cstddef>
#include <vector>

#include "variable/boundary/contact.h"

namespace carreau::variable {

/// Edges of one kind without a corner between them.
struct BoundaryRun {
  std::size_t first = 0;  ///< node that it starts at, and edge
  std::size_t count = 0;  ///< edges
  std::int32_t kind = 0;  ///< of its edges
  bool closed = false;    ///< a whole loop without a corner
};

/// Ends of runs: nodes where the kind of edges changes, bound nodes that a free edge leaves, and corners. At a corner
/// the boundary turns by more than `corner_angle` (degrees) and does not follow a tool.
std::vector<BoundaryRun> runs_of(const BoundaryLoop& loop, double corner_angle);

/// Ends of runs that are nearer to each other along the boundary than a share of h_min become one: bound nodes and
/// sharper corners stay.
void join_close_ends(BoundaryLoop& loop, const Tools& tools, double corner_angle, double h_min);

/// Removes nodes at which the boundary turns back and leaves an angle of the piece below 15 degrees: no triangle there
/// has a shape.
void cut_tips(BoundaryLoop& loop, const Tools& tools, double h_min);

/// Nodes that the removal of elements has just laid bare go `rounds` times halfway to the middle of their neighbours, by at
/// most a quarter of the shorter edge.
void smooth_imposed(BoundaryLoop& loop, int rounds);

}  // namespace carreau::variable
