// SPDX-License-Identifier: BSD-3-Clause
// Cells of a cross-patch mesh are cut: quadrilaterals in four, triangles in three.
#include <array>
#include <map>
#include <span>
#include <utility>

#include "surface/elements/cross_patch/element_cells.h"
#include "surface/elements/quads/passes.h"

namespace carreau {

void halve(AtlasSurface& surface, PlacedVertices& vertices, LineMiddles& lines, ElementCells& cells, Monitor& monitor) {
  for (const SharpLine& line : lines.lines())
    for (std::size_t k = 0; k + 1 < line.vertices.size(); ++k) (void)lines.middle_of(mesh_edge(line.vertices[k], line.vertices[k + 1]));
  SpaceQuads& quads = cells.quads;
  const auto add_near = [&](std::span<const std::int32_t> starts, const Vec3& target) {
    cells.vertex.push_back(-1);
    return quads.add_vertex(place_from(surface, quads, starts, target), false);
  };
  std::map<MeshEdge, std::int32_t> middles;  // by local vertices
  const auto middle_of = [&](std::int32_t a, std::int32_t b) {
    std::int32_t& middle = middles.try_emplace(mesh_edge(a, b), -1).first->second;
    if (middle >= 0) return middle;
    const std::array<std::int32_t, 2> ends = mesh_edge(a, b);
    if (!is_imposed(cells, lines, a, b)) return middle = add_near(ends, 0.5 * (quads.place(ends[0]).xyz + quads.place(ends[1]).xyz));
    const LineMiddle on_line = middle_on_line(vertices, lines, cells, ends);
    cells.vertex.push_back(on_line.vertex);
    return middle = quads.add_vertex(on_line.place, vertices.wanted(on_line.vertex), true);
  };
  std::size_t done = 0;
  const auto centre_of = [&](const MixedCell& cell) {
    if (done++ % 64 == 0) monitor.checkpoint();
    const auto n = static_cast<std::size_t>(corners_of(cell));
    Vec3 sum{0, 0, 0};
    for (std::size_t k = 0; k < n; ++k) sum += quads.place(cell[k]).xyz;
    return add_near({cell.data(), n}, (1.0 / static_cast<double>(n)) * sum);
  };
  quads.cells() = halved_cells(std::exchange(quads.cells(), {}), middle_of, centre_of);
  lines.halve();
  surface.scale_sizes(0.5);
  vertices.scale_sizes(0.5);
  quads.scale_sizes(0.5);
}

}  // namespace carreau
