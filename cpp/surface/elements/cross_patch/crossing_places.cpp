// SPDX-License-Identifier: BSD-3-Clause
#include "surface/elements/cross_patch/crossing_places.h"

#include <algorithm>

#include "mesh/crossings/intersections.h"
#include "mesh/flat_mesh.h"

namespace carreau {

std::vector<CrossingPlace> find_crossing_places(const SizedMesh& mesh, int threads, Monitor& monitor) {
  const FlatMesh flat = flatten(mesh.mesh, false);
  std::vector<std::size_t> first{0};  // triangle of each face
  for (const FaceMesh& face : mesh.mesh.faces) first.push_back(first.back() + face.triangles.size());
  std::vector<CrossingPlace> places;
  for (const TriangleIntersection& pair : find_intersections(flat.vertices, flat.triangles, {.threads = threads}, monitor).pairs) {
    CrossingPlace& here = places.emplace_back(CrossingPlace{pair.place, 0, {}});
    for (const std::int32_t t : pair.triangles) {
      const auto rank = static_cast<std::size_t>(t);
      const std::size_t f = static_cast<std::size_t>(std::ranges::upper_bound(first, rank) - first.begin()) - 1;
      const FaceMesh& face = mesh.mesh.faces[f];
      for (const std::int32_t v : face.triangles[rank - first[f]]) {
        here.size = std::max(here.size, mesh.vertex_size[face.vertex[v]]);
        here.faces.push_back(face.uv_face[v]);
      }
    }
    std::ranges::sort(here.faces);
    here.faces.erase(std::unique(here.faces.begin(), here.faces.end()), here.faces.end());
  }
  return places;
}

std::vector<CrossingPlace> new_places(const std::vector<CrossingPlace>& before, const std::vector<CrossingPlace>& now) {
  std::vector<CrossingPlace> fresh;
  for (const CrossingPlace& p : now)
    if (std::ranges::none_of(before, [&](const CrossingPlace& q) { return norm(q.place - p.place) <= p.size; })) fresh.push_back(p);
  return fresh;
}

}  // namespace carreau
