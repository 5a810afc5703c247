// SPDX-License-Identifier: BSD-3-Clause
#include "surface/elements/quads/quad_patch.h"

#include "surface/elements/quads/thresholds.h"

namespace carreau {

Incidence cells_around(std::size_t vertices, std::vector<MixedCell> cells) {
  for (MixedCell& cell : cells)
    if (cell[3] < 0) cell[3] = cell[0];
  return {vertices, cells};
}

FaceCharts::FaceCharts(const ControlSpace& space)
    : space_(&space), bends_(space.largest_bend() > thresholds::quads::min_bend) {}

Chart FaceCharts::about(const QuadPatch& patch, const MixedCell& cell) const noexcept {
  const Vec2 sum = patch.uv[cell[0]] + patch.uv[cell[1]] + patch.uv[cell[2]];
  if (corners_of(cell) == 3) return about((1.0 / 3) * sum);
  return about(0.25 * (sum + patch.uv[cell[3]]));
}

double length_in(const FaceCharts& charts, const Vec2& p, const Vec2& q) noexcept {
  const Chart chart = charts.about(0.5 * (p + q));
  return norm(chart.at(q) - chart.at(p));
}

}  // namespace carreau
