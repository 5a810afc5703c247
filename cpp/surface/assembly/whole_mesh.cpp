// SPDX-License-Identifier: BSD-3-Clause
#include "surface/assembly/whole_mesh.h"

#include <algorithm>
#include <array>

#include "model/bucket_sort.h"

namespace carreau {

namespace {

/// Calls `use` for each index of a vertex, or of a node on an edge.
template <typename Use>
void for_indices(SurfaceMesh& mesh, bool mids, const Use& use) {
  for (FaceMesh& face : mesh.faces)
    for (std::int32_t& v : mids ? face.mid_vertex : face.vertex) use(v);
  for (CurveMesh& curve : mesh.curves)
    for (std::int32_t& v : mids ? curve.mid : curve.vertices) use(v);
}

std::vector<std::int32_t> numbers_of_used(SurfaceMesh& mesh, bool mids) {
  std::vector<std::int32_t> number((mids ? mesh.mid_vertices : mesh.vertices).size(), -1);
  for_indices(mesh, mids, [&](std::int32_t v) { number[v] = 0; });
  std::int32_t next = 0;
  for (std::int32_t& n : number)
    if (n == 0) n = next++;
  for_indices(mesh, mids, [&](std::int32_t& v) { v = number[v]; });
  return number;
}

template <typename T>
void keep_numbered(const std::vector<std::int32_t>& number, std::vector<T>& values) {
  if (values.size() != number.size()) return;
  std::size_t kept = 0;
  for (std::size_t v = 0; v < number.size(); ++v)
    if (number[v] >= 0) values[kept++] = values[v];
  values.resize(kept);
}

}  // namespace

std::int64_t euler_number(const SurfaceMesh& mesh) {
  using Edge = std::array<std::int32_t, 2>;
  std::vector<Edge> edges;
  std::vector<char> used(mesh.vertices.size(), 0);
  for (const FaceMesh& face : mesh.faces)
    for (const auto& t : face.triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [a, b] = std::minmax(face.vertex[t[i]], face.vertex[t[(i + 1) % 3]]);
        edges.push_back({a, b});
        used[face.vertex[t[i]]] = 1;
      }
  bucket_sort(edges, mesh.vertices.size(), [](const Edge& e) { return e[0]; });
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return std::ranges::count(used, 1) - static_cast<std::int64_t>(edges.size()) + static_cast<std::int64_t>(mesh.triangle_count());
}

NewNumbers drop_unused(SizedMesh& made) {
  SurfaceMesh& mesh = made.mesh;
  NewNumbers numbers{numbers_of_used(mesh, false), numbers_of_used(mesh, true)};
  keep_numbered(numbers.vertex, mesh.vertices), keep_numbered(numbers.vertex, mesh.vertex_ref), keep_numbered(numbers.vertex, made.vertex_size);
  keep_numbered(numbers.mid, mesh.mid_vertices);
  return numbers;
}

}  // namespace carreau
