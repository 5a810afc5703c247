// SPDX-License-Identifier: BSD-3-Clause
// Sheets of one face that meet along an edge.
#pragma once

#include <functional>
#include <vector>

#include "surface/remesh/cells/cell_placer.h"

namespace carreau {

/// Gives the corners of the cells of a face their sheets. If two cells run along one edge the same way, cells that are connected over other
/// edges are one sheet at its ends. Elsewhere there is one sheet. `may_be_of_several`: a vertex on a line.
void part_sheets(std::vector<PlacedCell>& cells, const std::function<bool(std::int32_t)>& may_be_of_several);

}  // namespace carreau
