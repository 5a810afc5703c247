// SPDX-License-Identifier: BSD-3-Clause
#include "surface/free_elements/crossing_places.h"

#include <algorithm>

#include "mesh/flat_mesh.h"
#include "mesh/intersections.h"

namespace carreau {

std::vector<CrossingPlace> find_crossing_places(const SizedMesh& mesh, int threads, Monitor& monitor) {
  const FlatMesh flat = flatten(mesh.mesh, false);
  std::vector<CrossingPlace> places;
  for (const TriangleIntersection& pair : find_intersections(flat.vertices, flat.triangles, {.threads = threads}, monitor).pairs) {
    double size = 0;
    for (const std::int32_t t : pair.triangles)
      for (const std::int32_t v : flat.triangles[t])
        if (v < std::ssize(mesh.vertex_size)) size = std::max(size, mesh.vertex_size[v]);
    places.push_back({pair.place, size});
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
