// SPDX-License-Identifier: BSD-3-Clause
// Cells of a cross-patch mesh are cut: quadrilaterals in four, triangles in three.
#include <array>
#include <map>
#include <span>
#include <utility>

#include "surface/elements/cross_patch/element_cells.h"
#include "surface/elements/quads/passes.h"

namespace carreau {

namespace {

class Halving {
 public:
  Halving(const AtlasSurface& surface, const PlacedVertices& vertices, const LineMiddles& lines,
          const std::map<MeshEdge, std::int32_t>& on_lines, ElementCells& cells, Monitor& monitor)
      : surface_(surface), vertices_(vertices), lines_(lines), on_lines_(on_lines), cells_(cells), monitor_(monitor) {}

  void run() {
    std::size_t done = 0;
    cells_.quads.cells() = halved_cells(
        std::exchange(cells_.quads.cells(), {}), [&](std::int32_t a, std::int32_t b) { return middle_of(a, b); },
        [&](const MixedCell& cell) {
          if (done++ % 64 == 0) monitor_.checkpoint();
          return centre_of(cell);
        });
  }

 private:
  std::int32_t add(const SurfacePlace& place) {
    cells_.vertex.push_back(-1);
    return cells_.quads.add_vertex(place, false);
  }

  std::int32_t centre_of(const MixedCell& cell) {
    const auto n = static_cast<std::size_t>(corners_of(cell));
    Vec3 sum{0, 0, 0};
    for (std::size_t k = 0; k < n; ++k) sum += cells_.quads.place(cell[k]).xyz;
    return add_near({cell.data(), n}, (1.0 / static_cast<double>(n)) * sum);
  }
  std::int32_t add_near(std::span<const std::int32_t> starts, const Vec3& target) {
    if (const auto found = place_from(surface_, cells_.quads, starts, target)) return add(*found);
    SurfacePlace place = cells_.quads.place(starts[0]);
    place.xyz = target;
    return add(place);
  }

  std::int32_t middle_of(std::int32_t a, std::int32_t b) {
    const auto [found, is_new] = middle_.try_emplace(mesh_edge(a, b), -1);
    if (!is_new) return found->second;
    const auto [low, high] = std::minmax(a, b);
    return found->second = is_imposed(cells_, lines_, a, b) ? add_on_line(low, high) : add_inside(low, high);
  }
  std::int32_t add_on_line(std::int32_t a, std::int32_t b) {
    const std::int32_t m = on_lines_.at(mesh_edge(cells_.vertex[a], cells_.vertex[b]));
    const Vec3 normal = cells_.quads.place(a).normal + cells_.quads.place(b).normal;
    cells_.vertex.push_back(m);
    return cells_.quads.add_vertex(vertices_.place_towards(m, normal), vertices_.wanted(m), true);
  }
  std::int32_t add_inside(std::int32_t a, std::int32_t b) {
    return add_near(std::array{a, b}, 0.5 * (cells_.quads.place(a).xyz + cells_.quads.place(b).xyz));
  }

  const AtlasSurface& surface_;
  const PlacedVertices& vertices_;
  const LineMiddles& lines_;
  const std::map<MeshEdge, std::int32_t>& on_lines_;
  ElementCells& cells_;
  Monitor& monitor_;
  std::map<MeshEdge, std::int32_t> middle_;  // by local vertices
};

}  // namespace

void halve(AtlasSurface& surface, PlacedVertices& vertices, LineMiddles& lines, ElementCells& cells, Monitor& monitor) {
  std::map<MeshEdge, std::int32_t> on_lines;
  for (const SharpLine& line : lines.lines())
    for (std::size_t k = 0; k + 1 < line.vertices.size(); ++k) {
      const MeshEdge edge = mesh_edge(line.vertices[k], line.vertices[k + 1]);
      on_lines.try_emplace(edge, lines.middle_of(edge));
    }
  Halving(surface, vertices, lines, on_lines, cells, monitor).run();
  lines.halve();
  surface.scale_sizes(0.5);
  vertices.scale_sizes(0.5);
  cells.quads.scale_sizes(0.5);
}

}  // namespace carreau
