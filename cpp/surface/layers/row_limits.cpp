// SPDX-License-Identifier: BSD-3-Clause
#include "surface/layers/row_limits.h"

#include <algorithm>
#include <array>

#include "surface/layers/middle_columns.h"

namespace carreau {

bool limit_rows_at(int face, std::span<const Vec3> corners, int divisor, std::span<const LayerCell> cells,
                   const std::function<Vec3(std::int32_t)>& at, bool halved, std::vector<RowLimit>& limits) {
  const auto is_corner = [&](std::int32_t v) { return std::find(corners.begin(), corners.end(), at(v)) != corners.end(); };
  bool any = false;
  for (const auto& [first, end] : piles_of(cells)) {
    const PileSides sides(cells.subspan(first, end - first));
    if (std::none_of(sides.left.begin(), sides.left.end(), is_corner) && std::none_of(sides.right.begin(), sides.right.end(), is_corner))
      continue;
    any = true;
    const int rows = static_cast<int>(end - first), whole = halved ? (rows + 1) / 2 : rows;
    const Vec3 left = at(sides.left[0]), right = at(sides.right[0]);
    limits.push_back({.face = face, .place = 0.5 * (left + right), .reach = 0.501 * norm(right - left), .rows = divisor > 0 ? whole / divisor : 0});
  }
  return any;
}

}  // namespace carreau
