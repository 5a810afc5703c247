// SPDX-License-Identifier: BSD-3-Clause
#include "surface/layers/layer_figures.h"

#include <algorithm>
#include <map>

#include "support/infinity.h"

namespace carreau {
namespace {

double height_of(const SurfaceMesh& mesh, const FaceMesh& face, const LayerCell& cell) {
  const auto at = [&](std::size_t k) -> const Vec3& {
    return mesh.vertices[static_cast<std::size_t>(face.vertex[static_cast<std::size_t>(cell.corners[k])])];
  };
  const Vec3 a = at(0), b = at(1), c = at(2), d = at(3);
  const double area = 0.5 * norm(cross(c - a, d - b));
  return 2 * area / (norm(b - a) + norm(d - c));
}

}  // namespace

std::vector<LayerFigures> measure_layers(const SurfaceMesh& mesh, const std::vector<std::vector<LayerCell>>& layers,
                                         std::size_t count) {
  std::vector<LayerFigures> all(count);
  std::vector<std::int64_t> in_first(count, 0), grown(count, 0);
  for (LayerFigures& figures : all) {
    figures.first_min = figures.growth_min = infinity;
    figures.fewest_rows = INT32_MAX;
  }
  for (std::size_t f = 0; f < layers.size(); ++f) {
    const FaceMesh& face = mesh.faces[f];
    std::map<std::array<std::int32_t, 2>, std::pair<double, int>> below;  // by upper edge: height, and first row of the pile
    std::vector<int> rows;                                                // by pile
    std::vector<std::size_t> of_pile;
    for (const LayerCell& cell : layers[f]) {
      LayerFigures& figures = all[static_cast<std::size_t>(cell.layers)];
      ++figures.cells;
      figures.rows = std::max(figures.rows, cell.row + 1);
      if (cell.is_triangle()) continue;
      const double height = height_of(mesh, face, cell);
      const auto found = below.find({cell.corners[0], cell.corners[1]});
      int pile = static_cast<int>(rows.size());
      if (cell.row == 0) {
        figures.first_min = std::min(figures.first_min, height);
        figures.first_max = std::max(figures.first_max, height);
        figures.first_mean += height;
        ++in_first[static_cast<std::size_t>(cell.layers)];
      }
      if (found != below.end()) {
        pile = found->second.second;
        ++rows[static_cast<std::size_t>(pile)];
        const double growth = height / found->second.first;
        figures.growth_min = std::min(figures.growth_min, growth);
        figures.growth_max = std::max(figures.growth_max, growth);
        figures.growth_mean += growth;
        ++grown[static_cast<std::size_t>(cell.layers)];
      } else {
        rows.push_back(cell.row + 1);  // a triangle may lie below
        of_pile.push_back(static_cast<std::size_t>(cell.layers));
      }
      below[{cell.corners[3], cell.corners[2]}] = {height, pile};
    }
    for (std::size_t p = 0; p < rows.size(); ++p)
      all[of_pile[p]].fewest_rows = std::min(all[of_pile[p]].fewest_rows, rows[p]);
  }
  for (std::size_t i = 0; i < count; ++i) {
    LayerFigures& figures = all[i];
    if (in_first[i] > 0)
      figures.first_mean /= static_cast<double>(in_first[i]);
    else
      figures.first_min = 0, figures.fewest_rows = 0;
    if (grown[i] > 0)
      figures.growth_mean /= static_cast<double>(grown[i]);
    else
      figures.growth_min = 0;
  }
  return all;
}

}  // namespace carreau
