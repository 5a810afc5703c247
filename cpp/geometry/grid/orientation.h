// SPDX-License-Identifier: BSD-3-Clause
// One orientation for connected blocks.
#pragma once

#include <vector>

#include "geometry/grid/borders.h"

namespace carreau::grid {

/// [block]: 1: it is to be turned over. Over edges with two uses normals agree then, as far as a surface has two sides.
/// The first block of a connected set stays, but where blocks enclose a volume normals point outwards.
std::vector<char> blocks_to_turn(const std::vector<Block>& blocks, const std::vector<Cells>& cells,
                                 const Borders& borders);

/// Columns run backwards.
void turn_over(Block& block);

}  // namespace carreau::grid
