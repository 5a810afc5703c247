// SPDX-License-Identifier: BSD-3-Clause
// Cells of a free mesh are cut: quadrilaterals in four, triangles in three.
#include <array>
#include <map>
#include <utility>

#include "surface/free_elements/free_cells.h"

namespace carreau {

namespace {

class Halving {
 public:
  Halving(const FreeSurface& surface, const ElementVertices& vertices, const LineMiddles& lines,
          const std::map<MeshEdge, std::int32_t>& on_lines, FreeCells& cells, Monitor& monitor)
      : surface_(surface), vertices_(vertices), lines_(lines), on_lines_(on_lines), cells_(cells), monitor_(monitor) {}

  void run() {
    const std::vector<MixedCell> whole = std::exchange(cells_.quads.cells(), {});
    std::vector<MixedCell> parts;
    for (std::size_t c = 0; c < whole.size(); ++c) {
      if (c % 64 == 0) monitor_.checkpoint();
      const MixedCell& cell = whole[c];
      const int n = corners_of(cell);
      std::array<std::int32_t, 4> middle{};
      for (int k = 0; k < n; ++k) middle[k] = middle_of(cell[k], cell[(k + 1) % n]);
      const std::int32_t centre = centre_of(cell);
      for (int k = 0; k < n; ++k) parts.push_back({cell[k], middle[k], centre, middle[(k + n - 1) % n]});
    }
    cells_.quads.cells() = std::move(parts);
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
    const Vec3 target = (1.0 / static_cast<double>(n)) * sum;
    if (const auto found = place_from(surface_, cells_.quads, {cell.data(), n}, target)) return add(*found);
    SurfacePlace place = cells_.quads.place(cell[0]);
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
    const Vec3 target = 0.5 * (cells_.quads.place(a).xyz + cells_.quads.place(b).xyz);
    if (const auto found = place_from(surface_, cells_.quads, std::array{a, b}, target)) return add(*found);
    SurfacePlace place = cells_.quads.place(a);
    place.xyz = target;
    return add(place);
  }

  const FreeSurface& surface_;
  const ElementVertices& vertices_;
  const LineMiddles& lines_;
  const std::map<MeshEdge, std::int32_t>& on_lines_;
  FreeCells& cells_;
  Monitor& monitor_;
  std::map<MeshEdge, std::int32_t> middle_;  // by local vertices
};

}  // namespace

void halve(FreeSurface& surface, ElementVertices& vertices, LineMiddles& lines, FreeCells& cells, Monitor& monitor) {
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
