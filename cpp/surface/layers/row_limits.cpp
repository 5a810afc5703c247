// SPDX-License-Identifier: BSD-3-Clause
#include "surface/layers/row_limits.h"

#include <algorithm>
#include <array>

#include "surface/layers/middle_columns.h"

namespace carreau {

void halve_rows_near(int face, const Vec3& place, double reach, std::span<const LayerCell> cells,
                     const std::function<Vec3(std::int32_t)>& at, bool halved, std::vector<RowLimit>& limits) {
  for (const auto& [first, end] : piles_of(cells)) {
    const PileSides sides(cells.subspan(first, end - first));
    const auto is_near = [&](std::int32_t v) { return norm(at(v) - place) <= reach; };
    if (std::none_of(sides.left.begin(), sides.left.end(), is_near) && std::none_of(sides.right.begin(), sides.right.end(), is_near))
      continue;
    const int rows = static_cast<int>(end - first), whole = halved ? (rows + 1) / 2 : rows;
    const Vec3 left = at(sides.left[0]), right = at(sides.right[0]);
    limits.push_back({.face = face, .place = 0.5 * (left + right), .reach = 0.501 * norm(right - left), .rows = whole / 2});
  }
}

}  // namespace carreau
