// SPDX-License-Identifier: BSD-3-Clause
#include "measure/base/mesh_edges.h"

#include <algorithm>

namespace carreau {

namespace {

std::uint64_t key_of(std::int32_t a, std::int32_t b) noexcept {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(std::min(a, b))) << 32 |
         static_cast<std::uint32_t>(std::max(a, b));
}

struct Side {
  std::uint64_t key;
  std::size_t corner;  // 3 * triangle + i
};

std::vector<Side> sorted_sides(const SurfaceMesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangle_count());
  for (const FaceMesh& face : mesh.faces)
    for (const auto& t : face.triangles)
      for (std::size_t i = 0; i < 3; ++i)
        sides.push_back({key_of(face.vertex[t[i]], face.vertex[t[(i + 1) % 3]]), sides.size()});
  std::sort(sides.begin(), sides.end(),
            [](const Side& p, const Side& q) { return p.key != q.key ? p.key < q.key : p.corner < q.corner; });
  return sides;
}

void mark_segments(const SurfaceMesh& mesh, const std::vector<Side>& sides, MeshEdges& edges) {
  edges.segment.assign(edges.vertices.size(), -1);
  for (std::size_t c = 0; c < mesh.curves.size(); ++c) {
    const std::vector<std::int32_t>& chain = mesh.curves[c].vertices;
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      const std::uint64_t key = key_of(chain[i], chain[i + 1]);
      const auto it =
          std::lower_bound(sides.begin(), sides.end(), key, [](const Side& s, std::uint64_t k) { return s.key < k; });
      if (it == sides.end() || it->key != key) continue;
      std::int32_t& segment = edges.segment[edges.of_triangle[it->corner / 3][it->corner % 3]];
      if (segment >= 0) continue;
      segment = static_cast<std::int32_t>(edges.segments.size());
      edges.segments.push_back({static_cast<std::int32_t>(c), static_cast<std::int32_t>(i)});
    }
  }
}

}  // namespace

MeshEdges edges_of(const SurfaceMesh& mesh) {
  const std::vector<Side> sides = sorted_sides(mesh);
  MeshEdges edges;
  edges.of_triangle.resize(sides.size() / 3);
  edges.names.resize(sides.size() / 3);
  for (std::size_t i = 0; i < sides.size(); ++i)
    edges.names[sides[i].corner / 3][sides[i].corner % 3] = i == 0 || sides[i].key != sides[i - 1].key;
  std::int32_t count = 0;
  for (std::size_t t = 0; t < edges.names.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      if (edges.names[t][i] != 0) edges.of_triangle[t][i] = count++;
  edges.vertices.resize(count);
  std::int32_t edge = -1;
  for (const Side& side : sides) {
    std::int32_t& own = edges.of_triangle[side.corner / 3][side.corner % 3];
    if (edges.names[side.corner / 3][side.corner % 3] != 0) {
      edge = own;
      edges.vertices[edge] = {static_cast<std::int32_t>(side.key >> 32),
                              static_cast<std::int32_t>(side.key & 0xffffffffU)};
    }
    own = edge;
  }
  mark_segments(mesh, sides, edges);
  return edges;
}

}  // namespace carreau
