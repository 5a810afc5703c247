// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/cells.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <vector>

#include "mesh/quality.h"
#include "mesh/surface_mesh.h"

namespace carreau {

namespace {

// The nodes on the edges of a quadrilateral whose halves are the triangles t and t + 1, or of the triangle t.
void add_mids(const FaceMesh& face, std::size_t t, Cell& cell) {
  const std::int32_t first = static_cast<std::int32_t>(face.uv.size());
  const std::array<std::int32_t, 3>& m = face.mid[t];
  if (cell.kind == CellKind::quad8) {
    const std::array<std::int32_t, 3>& n = face.mid[t + 1];
    cell.nodes[4] = first + m[0], cell.nodes[5] = first + m[1];
    cell.nodes[6] = first + n[1], cell.nodes[7] = first + n[2];
  } else {
    for (std::size_t i = 0; i < 3; ++i) cell.nodes[3 + i] = first + m[i];
  }
}

double worse_half(std::span<const Vec3> xyz, const std::array<std::int32_t, 4>& v) {
  return std::min(quality_q2(xyz[v[0]], xyz[v[1]], xyz[v[2]]), quality_q2(xyz[v[0]], xyz[v[2]], xyz[v[3]]));
}

// Two quadrilaterals of a pole that meet in two edges there: as halves on the same side of it they would be one triangle.
void part_equal_halves(FaceMesh& face) {
  std::set<std::array<std::int32_t, 3>> met;
  const auto corners = [&](const std::array<std::int32_t, 3>& t) {
    std::array<std::int32_t, 3> v{face.vertex[t[0]], face.vertex[t[1]], face.vertex[t[2]]};
    std::sort(v.begin(), v.end());
    return v;
  };
  for (std::int32_t q = 0; q < face.quads; ++q) {
    std::array<std::int32_t, 3>&one = face.triangles[2 * q], &other = face.triangles[2 * q + 1];
    if (met.contains(corners(one)) || met.contains(corners(other))) {
      const auto [a, b, c, d] = face.quad(static_cast<std::size_t>(q));
      one = {b, c, d}, other = {b, d, a};
    }
    met.insert(corners(one)), met.insert(corners(other));
  }
}

using Edge = std::array<std::int32_t, 2>;

Edge in_space(const FaceMesh& face, std::int32_t a, std::int32_t b) {
  const auto [low, high] = std::minmax(face.vertex[a], face.vertex[b]);
  return {low, high};
}

/// Turns diagonals that are edges of other cells. A side of two cells is listed twice, a diagonal once.
class EqualDiagonals {
 public:
  explicit EqualDiagonals(std::vector<FaceMesh>& faces) : faces_(faces) {}

  void part() {
    if (std::ranges::all_of(faces_, [](const FaceMesh& face) { return face.quads == 0; })) return;
    list_edges();
    find_shared();
    for (bool any = !shared_.empty(); any;) {
      any = false;
      for (const Quad& quad : shared_) any = turn(quad) || any;
    }
  }

 private:
  struct Quad {
    std::size_t face, rank;
  };
  struct Diagonal {
    Edge edge;
    Quad quad;
  };

  void list_edges() {
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const FaceMesh& face = faces_[f];
      const auto halves = 2 * static_cast<std::size_t>(face.quads);
      for (std::size_t t = 0; t < face.triangles.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) {
          const bool diagonal = t < halves && i == (t % 2 == 0 ? 2U : 0U);
          if (diagonal && t % 2 != 0) continue;
          edges_.push_back(in_space(face, face.triangles[t][i], face.triangles[t][(i + 1) % 3]));
          if (diagonal && face.flattened.empty()) diagonals_.push_back({edges_.back(), {f, t / 2}});
        }
    }
    std::ranges::sort(edges_);
  }

  // The last ones turn first, so that the first quadrilateral keeps its better halves.
  void find_shared() {
    for (const Diagonal& d : diagonals_)
      if (uses(d.edge) > 1) shared_.push_back(d.quad);
    std::ranges::reverse(shared_);
  }

  [[nodiscard]] std::ptrdiff_t uses(const Edge& edge) const {
    const auto [first, last] = std::equal_range(edges_.begin(), edges_.end(), edge);
    const auto turned = turned_.find(edge);
    return last - first + (turned == turned_.end() ? 0 : turned->second);
  }

  bool turn(const Quad& quad) {
    FaceMesh& face = faces_[quad.face];
    const auto [a, b, c, d] = face.quad(quad.rank);
    const Edge now = in_space(face, a, c), other = in_space(face, b, d);
    if (uses(now) == 1 || uses(other) > 0 || other[0] == other[1]) return false;
    face.triangles[2 * quad.rank] = {b, c, d}, face.triangles[2 * quad.rank + 1] = {b, d, a};
    --turned_[now], ++turned_[other];
    return true;
  }

  std::vector<FaceMesh>& faces_;
  std::vector<Edge> edges_;  // ascending
  std::vector<Diagonal> diagonals_;
  std::vector<Quad> shared_;
  std::map<Edge, std::ptrdiff_t> turned_;  // uses added, less uses removed
};

}  // namespace

std::vector<Cell> local_cells(const FaceMesh& face) {
  std::vector<Cell> cells;
  cells.reserve(face.cell_count());
  const bool quadratic = !face.mid.empty();
  const auto halves = 2 * static_cast<std::size_t>(face.quads);
  for (std::size_t t = 0; t < face.triangles.size(); t += t < halves ? 2 : 1) {
    Cell cell;
    if (t < halves) {
      cell.kind = quadratic ? CellKind::quad8 : CellKind::quad4;
      std::ranges::copy(face.quad(t / 2), cell.nodes.begin());
    } else {
      cell.kind = quadratic ? CellKind::triangle6 : CellKind::triangle3;
      std::ranges::copy(face.triangles[t], cell.nodes.begin());
    }
    if (quadratic) add_mids(face, t, cell);
    cells.push_back(cell);
  }
  return cells;
}

std::vector<Cell> cells_of(const SurfaceMesh& mesh, const FaceMesh& face) {
  std::vector<Cell> cells = local_cells(face);
  const auto corners = static_cast<std::int32_t>(face.uv.size()), all = static_cast<std::int32_t>(mesh.vertices.size());
  for (Cell& cell : cells)
    for (std::int32_t& node : cell.nodes)
      if (node >= 0) node = node < corners ? face.vertex[node] : all + face.mid_vertex[node - corners];
  return cells;
}

void set_cells(FaceMesh& face, std::span<const std::array<std::int32_t, 4>> quads,
               std::span<const std::array<std::int32_t, 3>> triangles, std::span<const Vec3> vertices) {
  face.quads = static_cast<std::int32_t>(quads.size());
  face.triangles.clear();
  face.mid.clear(), face.mid_uv.clear(), face.mid_vertex.clear();
  for (const std::array<std::int32_t, 4>& q : quads) {
    const auto [a, b, c, d] = q;
    const std::array<std::int32_t, 4> one{face.vertex[a], face.vertex[b], face.vertex[c], face.vertex[d]},
        other{one[1], one[2], one[3], one[0]};
    if (worse_half(vertices, other) > worse_half(vertices, one)) {
      face.triangles.push_back({b, c, d});
      face.triangles.push_back({b, d, a});
    } else {
      face.triangles.push_back({a, b, c});
      face.triangles.push_back({a, c, d});
    }
  }
  if (!face.flattened.empty()) part_equal_halves(face);
  face.triangles.insert(face.triangles.end(), triangles.begin(), triangles.end());
}

void part_equal_diagonals(SurfaceMesh& mesh) { EqualDiagonals(mesh.faces).part(); }

}  // namespace carreau
