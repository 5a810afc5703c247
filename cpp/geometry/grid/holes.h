// SPDX-License-Identifier: BSD-3-Clause
// Holes: missing nodes with nodes all around them.
#pragma once

#include <cstddef>

#include "geometry/grid/grid.h"
#include "geometry/grid/smoothing.h"

namespace carreau::grid {

/// Places the missing nodes of holes that no side of the block touches on a membrane over their rims. Each node is the
/// mean of its four neighbours (thresholds::still_share). Returns the number of filled nodes. Looks for a stop between
/// sweeps.
std::size_t fill_holes(Block& block, const Closed& closed, Monitor& monitor);

}  // namespace carreau::grid
