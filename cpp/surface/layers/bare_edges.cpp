// SPDX-License-Identifier: BSD-3-Clause
#include "surface/layers/bare_edges.h"

#include <algorithm>
#include <array>
#include <map>

namespace carreau {

std::vector<BareEdges> find_bare_edges(const SurfaceMesh& mesh, const std::vector<std::vector<LayerCell>>& cells,
                                       std::span<const CurveLayers> layers) {
  std::map<std::array<std::int32_t, 3>, int> covered;  // by face and both ends, ascending
  const auto key = [](std::int32_t face, std::int32_t a, std::int32_t b) {
    return std::array{face, std::min(a, b), std::max(a, b)};
  };
  for (std::size_t f = 0; f < cells.size(); ++f)
    for (const LayerCell& cell : cells[f]) {
      const std::vector<std::int32_t>& vertex = mesh.faces[f].vertex;
      if (cell.row == 0 && !cell.is_triangle())
        ++covered[key(static_cast<std::int32_t>(f), vertex[static_cast<std::size_t>(cell.corners[0])],
                      vertex[static_cast<std::size_t>(cell.corners[1])])];
    }
  std::vector<BareEdges> all(layers.size());
  for (const CurveMesh& curve : mesh.curves) {
    const auto of = std::find_if(layers.begin(), layers.end(), [&](const CurveLayers& each) {
      const auto names = [&](int ref) { return ref == curve.ref || ref == curve.shown_ref(); };
      return std::any_of(each.curves.begin(), each.curves.end(), names);
    });
    if (of == layers.end()) continue;
    BareEdges& edges = all[static_cast<std::size_t>(of - layers.begin())];
    std::map<std::int32_t, int> sides_on;  // of each edge, by face: a seam has two
    for (const CurveMeshUse& use : curve.uses) sides_on[use.face] += use.internal ? 2 : 1;
    for (const auto& [f, sides] : sides_on) {
      const FaceMesh& face = mesh.faces[static_cast<std::size_t>(f)];
      if (face.triangles.empty()) continue;
      const std::int64_t before = edges.bare;
      for (std::size_t k = 0; k + 1 < curve.vertices.size(); ++k) {
        const auto found = covered.find(key(f, curve.vertices[k], curve.vertices[k + 1]));
        const int bare = sides - std::min(sides, found != covered.end() ? found->second : 0);
        edges.sides += sides, edges.bare += bare;
      }
      if (edges.bare > before) edges.curves.push_back({.curve = curve.shown_ref(), .face = face.ref, .bare = edges.bare - before});
    }
  }
  return all;
}

}  // namespace carreau
