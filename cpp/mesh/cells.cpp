// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/cells.h"

#include <algorithm>
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

std::array<std::int32_t, 2> in_space(const FaceMesh& face, std::int32_t a, std::int32_t b) {
  const auto [low, high] = std::minmax(face.vertex[a], face.vertex[b]);
  return {low, high};
}

// Quadrilaterals may meet in two edges at a fixed vertex, and others beside a fold: a diagonal that is an edge of the face, or a
// diagonal of another quadrilateral, would be an edge of four triangles. The other diagonal takes its place.
void part_equal_diagonals(FaceMesh& face, std::span<const std::array<std::int32_t, 4>> quads,
                          std::span<const std::array<std::int32_t, 3>> triangles) {
  std::vector<std::array<std::int32_t, 2>> edges;
  edges.reserve(4 * quads.size() + 3 * triangles.size());
  const auto add_sides = [&](const auto& cell) {
    for (std::size_t i = 0; i < cell.size(); ++i) edges.push_back(in_space(face, cell[i], cell[(i + 1) % cell.size()]));
  };
  for (const auto& quad : quads) add_sides(quad);
  for (const auto& triangle : triangles) add_sides(triangle);
  std::ranges::sort(edges);
  std::set<std::array<std::int32_t, 2>> diagonals;
  const auto is_taken = [&](const std::array<std::int32_t, 2>& edge) {
    return diagonals.contains(edge) || std::ranges::binary_search(edges, edge);
  };
  for (std::size_t q = 0; q < quads.size(); ++q) {
    const auto [a, b, c, d] = face.quad(q);
    const std::array<std::int32_t, 2> one = in_space(face, a, c), other = in_space(face, b, d);
    const bool turns = is_taken(one) && !is_taken(other);
    if (turns) face.triangles[2 * q] = {b, c, d}, face.triangles[2 * q + 1] = {b, d, a};
    diagonals.insert(turns ? other : one);
  }
}

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
  if (face.flattened.empty())
    part_equal_diagonals(face, quads, triangles);
  else
    part_equal_halves(face);
  face.triangles.insert(face.triangles.end(), triangles.begin(), triangles.end());
}

}  // namespace carreau
