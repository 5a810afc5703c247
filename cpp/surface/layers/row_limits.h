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

/// Adds limits for the piles of cells within `reach` of `place`: they lose half of their rows. `halved`: the cells were cut in two each way.
void halve_rows_near(int face, const Vec3& place, double reach, std::span<const LayerCell> cells,
                     const std::function<Vec3(std::int32_t)>& at, bool halved, std::vector<RowLimit>& limits);

}  // namespace carreau
