// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/surface_distance.h"

#include <algorithm>

#include "mesh/triangle_search.h"

namespace carreau {

double largest_distance(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
                        std::span<const Vec3> to_vertices, std::span<const std::array<std::int32_t, 3>> to_triangles,
                        Monitor& monitor) {
  const TriangleSearch search(to_vertices, to_triangles, &monitor);
  if (search.empty()) return 0;
  double most = 0;
  std::int32_t guess = 0, count = 0;
  const auto look = [&](const Vec3& p) {
    const NearestOnMesh nearest = search.nearest(p, guess);
    guess = nearest.triangle;
    most = std::max(most, nearest.distance);
  };
  for (const auto& t : triangles) {
    if (count++ % 256 == 0) monitor.checkpoint();
    const std::array<Vec3, 3> p{vertices[static_cast<std::size_t>(t[0])], vertices[static_cast<std::size_t>(t[1])],
                                vertices[static_cast<std::size_t>(t[2])]};
    look((p[0] + p[1] + p[2]) / 3);
    for (std::size_t i = 0; i < 3; ++i) {
      look(p[i]);
      look(0.5 * (p[i] + p[(i + 1) % 3]));
    }
  }
  return most;
}

}  // namespace carreau
