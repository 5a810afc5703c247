// SPDX-License-Identifier: BSD-3-Clause
#include "surface/elements/cross_patch/element_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "model/triangle_sides.h"
#include "model/union_find.h"
#include "surface/elements/quads/thresholds.h"

namespace carreau {

namespace {

class CellMaker {
 public:
  CellMaker(const AtlasSurface& surface, const PlacedVertices& vertices, const LineMiddles& lines,
            const std::vector<SpaceCell>& triangles)
      : charts_(surface.charts()),
        vertices_(vertices),
        lines_(lines),
        triangles_(triangles),
        corners_(3 * triangles.size()),
        pieces_(triangles.size()),
        made_{SpaceQuads(surface), {}} {}

  ElementCells run(Monitor& monitor) {
    join_over_edges();
    monitor.checkpoint();
    find_sides();
    add_vertices();
    monitor.checkpoint();
    find_flat_corners();
    monitor.checkpoint();
    return std::move(made_);
  }

 private:
  void join_over_edges() {
    const auto sides = sides_of_triangles(triangles_.size(), vertices_.vertices(), [&](std::size_t t, std::size_t i) { return triangles_[t][i]; });
    for_edges(sides, [&](std::span<const TriangleSide> of_edge) {
      if (of_edge.size() == 2 && !lines_.is_edge(of_edge[0].edge)) join(of_edge[0], of_edge[1]);
    });
  }
  void join(const TriangleSide& s, const TriangleSide& t) {
    const auto at = [&](const TriangleSide& side, int k) { return triangles_[side.triangle][(side.rank + k) % 3]; };
    if (at(s, 0) != at(t, 1)) return;  // a Moebius strip
    corners_.merge(3 * s.triangle + s.rank, 3 * t.triangle + (t.rank + 1) % 3);
    corners_.merge(3 * s.triangle + (s.rank + 1) % 3, 3 * t.triangle + t.rank);
    pieces_.merge(s.triangle, t.triangle);
  }

  [[nodiscard]] std::int32_t side_of(const SurfacePlace& place) const {
    return place.foot.triangle < 0 ? -1 : charts_.triangles()[place.foot.triangle].side;
  }

  // A piece between lines lies on one side of the atlas, which all its vertices have.
  void find_sides() {
    sides_.resize(triangles_.size());
    std::vector<char> begun(triangles_.size(), 0);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const std::size_t piece = pieces_.find(t);
      std::vector<std::int32_t>& common = sides_[piece];
      for (std::size_t i = 0; i < 3 && (begun[piece] == 0 || common.size() > 1); ++i) {
        std::vector<std::int32_t> here;
        for (const SurfacePlace& place : vertices_.places(triangles_[t][i])) here.push_back(side_of(place));
        if (begun[piece] == 0)
          common = here, begun[piece] = 1;
        else
          std::erase_if(common, [&here](std::int32_t side) { return std::ranges::find(here, side) == here.end(); });
      }
    }
  }

  // At a corner where the normals of several faces are equally near to a large triangle's, its piece decides.
  [[nodiscard]] const SurfacePlace& place_of(std::int32_t v, const Vec3& normal, std::size_t piece) const {
    const std::vector<std::int32_t>& sides = sides_[piece];
    const SurfacePlace* best = nullptr;
    for (const SurfacePlace& place : vertices_.places(v))
      if (place.regular && std::ranges::find(sides, side_of(place)) != sides.end() &&
          (best == nullptr || dot(place.normal, normal) > dot(best->normal, normal)))
        best = &place;
    return best != nullptr ? *best : vertices_.place_towards(v, normal);
  }

  void add_vertices() {
    const std::size_t n = 3 * triangles_.size();
    std::vector<Vec3> normal(n, Vec3{0, 0, 0});
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const auto at = [&](int k) { return vertices_.position(triangles_[t][k]); };
      const Vec3 own = cross(at(1) - at(0), at(2) - at(0));
      for (std::size_t i = 0; i < 3; ++i) normal[corners_.find(3 * t + i)] += own;
    }
    std::vector<std::int32_t> local(n, -1);  // by root
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      MixedCell& cell = made_.quads.cells().emplace_back(MixedCell{-1, -1, -1, -1});
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t root = corners_.find(3 * t + i);
        const std::int32_t v = triangles_[t][i];
        if (local[root] < 0) {
          local[root] = made_.quads.add_vertex(place_of(v, normal[root], pieces_.find(t)), vertices_.wanted(v),
                                               !vertices_.is_free(v));
          made_.vertex.push_back(v);
        }
        cell[i] = local[root];
      }
    }
  }

  // Finds corners where a line passes a side: its two edges there go on into each other.
  void find_flat_corners() {
    std::map<std::int32_t, std::vector<std::int32_t>> ends;  // of imposed edges, by local vertex
    for (const MixedCell& cell : made_.quads.cells())
      for (int k = 0; k < 3; ++k) {
        const std::int32_t a = cell[k], b = cell[(k + 1) % 3];
        if (is_imposed(made_, lines_, a, b)) ends[a].push_back(b), ends[b].push_back(a);
      }
    std::map<std::int32_t, int> lines_at;  // edges of lines at a vertex of space
    for (const SharpLine& line : lines_.lines())
      for (std::size_t k = 0; k + 1 < line.vertices.size(); ++k) ++lines_at[line.vertices[k]], ++lines_at[line.vertices[k + 1]];
    std::vector<std::array<std::int32_t, 3>> flat;
    for (auto& [v, others] : ends) {
      std::ranges::sort(others);
      others.erase(std::unique(others.begin(), others.end()), others.end());
      const bool inside = lines_at[made_.vertex[v]] == 2;
      for (const std::int32_t a : others)
        for (const std::int32_t b : others)
          if (a != b && goes_on(a, v, b, inside)) flat.push_back({v, a, b});
    }
    std::ranges::sort(flat);
    made_.quads.set_flat(std::move(flat));
  }
  [[nodiscard]] bool goes_on(std::int32_t a, std::int32_t v, std::int32_t b, bool inside) const {
    using namespace thresholds::quads;
    const Vec3 p = made_.quads.place(v).xyz, d = made_.quads.place(a).xyz - p, e = made_.quads.place(b).xyz - p;
    const double least = inside ? min_angle_in_curve : min_angle_of_curves;
    return dot(d, e) < std::cos(least * std::numbers::pi / 180) * norm(d) * norm(e);
  }

  const Charts& charts_;
  const PlacedVertices& vertices_;
  const LineMiddles& lines_;
  const std::vector<SpaceCell>& triangles_;
  UnionFind corners_;  // corners of triangles that are one vertex of a smooth side
  UnionFind pieces_;   // triangles that are joined without a line between
  std::vector<std::vector<std::int32_t>> sides_ = {};  // by root of a piece: sides of the atlas
  ElementCells made_;
};

}  // namespace

ElementCells element_cells(const AtlasSurface& surface, const PlacedVertices& vertices, const LineMiddles& lines,
                     const std::vector<SpaceCell>& triangles, Monitor& monitor) {
  return CellMaker(surface, vertices, lines, triangles).run(monitor);
}

bool is_imposed(const ElementCells& cells, const LineMiddles& lines, std::int32_t a, std::int32_t b) {
  if (!cells.quads.is_fixed(a) || !cells.quads.is_fixed(b)) return false;
  return lines.is_edge(mesh_edge(cells.vertex[a], cells.vertex[b]));
}

LineMiddle middle_on_line(const PlacedVertices& vertices, LineMiddles& lines, const ElementCells& cells, const MeshEdge& local) {
  const auto [a, b] = local;
  const std::int32_t m = lines.middle_of(mesh_edge(cells.vertex[a], cells.vertex[b]));
  return {vertices.place_towards(m, cells.quads.place(a).normal + cells.quads.place(b).normal), m};
}

SurfacePlace place_from(const AtlasSurface& surface, const SpaceQuads& quads, std::span<const std::int32_t> starts, const Vec3& target) {
  for (const std::int32_t v : starts)
    if (const SurfacePlace& from = quads.place(v); from.regular)
      if (const auto found = surface.towards(from, target)) return *found;
  // The place of a start on a line may belong to the other side of the line. Only the line itself can be reached from
  // there.
  std::optional<SurfacePlace> best;
  for (const std::int32_t v : starts) {
    const SurfacePlace& from = quads.place(v);
    if (!from.regular) continue;
    const auto found = surface.beside(from, target);
    if (found && (!best || norm(found->xyz - target) < norm(best->xyz - target))) best = found;
  }
  if (best) return *best;
  SurfacePlace place = quads.place(starts[0]);
  place.xyz = target;
  return place;
}

void put_vertices(const ElementCells& cells, PlacedVertices& vertices, std::vector<std::int32_t>& vertex) {
  vertex = cells.vertex;
  std::vector<char> used(vertex.size(), 0);
  for (const MixedCell& cell : cells.quads.cells())
    for (int k = 0; k < corners_of(cell); ++k) used[cell[k]] = 1;
  for (std::size_t v = 0; v < vertex.size(); ++v) {
    if (used[v] == 0) continue;
    const auto local = static_cast<std::int32_t>(v);
    if (vertex[v] < 0)
      vertex[v] = vertices.add(cells.quads.place(v), cells.quads.wanted(local));
    else if (!cells.quads.is_fixed(v))
      vertices.move(vertex[v], cells.quads.place(v), cells.quads.wanted(local));
  }
}

}  // namespace carreau
