// SPDX-License-Identifier: BSD-3-Clause
// Meshes with known vertices: grids over parameter rectangles, lifted and joined.
#pragma once

#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "common/analytic_cad.h"
#include "mesh/surface_mesh.h"

namespace carreau::testing {

struct Grid {
  int face = 1;
  Vec2 low{0, 0}, high{1, 1};
  int columns = 1, rows = 1;
};

/// Two triangles a cell, the diagonal from the lower left corner. Vertices at one place of space are one; triangles
/// that this flattens are kept apart.
inline SurfaceMesh grid_mesh(AnalyticCad& cad, std::span<const Grid> grids) {
  SurfaceMesh mesh;
  std::map<std::tuple<long long, long long, long long>, std::int32_t> known;
  const auto vertex_at = [&](Vec3 p) {
    const auto cell = [](double x) { return std::llround(x * 1e9); };
    const auto [it, is_new] =
        known.try_emplace({cell(p.x()), cell(p.y()), cell(p.z())}, static_cast<std::int32_t>(mesh.vertices.size()));
    if (is_new) mesh.vertices.push_back(p), mesh.vertex_ref.push_back(0);
    return it->second;
  };
  for (const Grid& grid : grids) {
    FaceMesh face;
    face.ref = grid.face;
    face.status = FaceStatus::meshed;
    for (int j = 0; j <= grid.rows; ++j)
      for (int i = 0; i <= grid.columns; ++i) {
        const Vec2 size = grid.high - grid.low;
        const Vec2 uv{grid.low.x() + size.x() * i / grid.columns, grid.low.y() + size.y() * j / grid.rows};
        face.uv.push_back(uv);
        face.vertex.push_back(vertex_at(surface_at(cad, grid.face, want_position, uv).s));
      }
    const auto at = [&](int i, int j) { return static_cast<std::int32_t>(j * (grid.columns + 1) + i); };
    for (int j = 0; j < grid.rows; ++j)
      for (int i = 0; i < grid.columns; ++i)
        for (const std::array<std::int32_t, 3> t : {std::array{at(i, j), at(i + 1, j), at(i + 1, j + 1)},
                                                    std::array{at(i, j), at(i + 1, j + 1), at(i, j + 1)}}) {
          const std::int32_t a = face.vertex[t[0]], b = face.vertex[t[1]], c = face.vertex[t[2]];
          (a == b || b == c || c == a ? face.flattened : face.triangles).push_back(t);
        }
    mesh.faces.push_back(std::move(face));
  }
  return mesh;
}

}  // namespace carreau::testing
