// SPDX-License-Identifier: BSD-3-Clause
// Places where fewer rows may stand, since elements beside them had faults.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "mesh/layer_cell.h"
#include "support/vec.h"

namespace carreau {

/// Columns of a face whose bases lie within `reach` of `place` have at most `rows` rows.
struct RowLimit {
  int face = 0;  ///< index in Model::faces
  Vec3 place;
  double reach = 0;
  int rows = 0;
};

/// Adds limits for the piles of cells that have one of `corners` as a vertex: an element with a fault has them. The piles keep the
/// `divisor`-th part of their rows; none if it is 0. `halved`: the cells were cut in two each way. Returns false if no pile has one.
bool limit_rows_at(int face, std::span<const Vec3> corners, int divisor, std::span<const LayerCell> cells,
                   const std::function<Vec3(std::int32_t)>& at, bool halved, std::vector<RowLimit>& limits);

}  // namespace carreau
