// SPDX-License-Identifier: BSD-3-Clause
#include "atlas/covering/frame.h"

#include <cmath>

namespace carreau::atlas {

Vec3 area_vector(const Triangulation& surface, std::int32_t a, std::int32_t b, std::int32_t c) {
  const auto at = [&](std::int32_t v) -> const Vec3& { return surface.vertices[static_cast<std::size_t>(v)]; };
  return cross(at(b) - at(a), at(c) - at(a)) / 2;
}

Frame frame_of(const Triangulation& surface, const Fans& fans, const std::vector<std::int32_t>& members) {
  Frame frame;
  std::vector<Vec3> normals;
  std::vector<std::int32_t> at;
  Vec3 sum(0, 0, 0);
  for (const std::int32_t m : members) {
    frame.origin += surface.vertices[static_cast<std::size_t>(m)] / static_cast<double>(members.size());
    const auto& fan = fans.around(m);
    for (std::size_t k = 0; k < fan.size(); ++k) {
      const Vec3 area = area_vector(surface, m, fan[k], fan[(k + 1) % fan.size()]);
      const double size = norm(area);
      if (!(size > 0)) continue;
      sum += area;
      normals.push_back(area / size), at.push_back(m);
    }
  }
  const auto steepest = [&](const Vec3& n) {
    std::size_t worst = 0;
    for (std::size_t i = 1; i < normals.size(); ++i)
      if (dot(normals[i], n) < dot(normals[worst], n)) worst = i;
    return worst;
  };
  if (normals.empty()) return frame;
  Vec3 n = norm(sum) > 0 ? Vec3(sum / norm(sum)) : normals[0];
  // Towards the centre of the smallest cone that holds all normals, from the mean of normals (steps of Badoiu and
  // Clarkson).
  Vec3 best = n;
  constexpr int steps = 40;
  for (int i = 1; i <= steps; ++i) {
    const std::size_t w = steepest(n);
    if (dot(normals[w], n) > dot(normals[steepest(best)], best)) best = n;
    const Vec3 moved = n + (normals[w] - n) / (i + 1);
    if (!(norm(moved) > 0)) break;
    n = moved / norm(moved);
  }
  const std::size_t worst = steepest(best);
  frame.normal = best, frame.min_cosine = dot(normals[worst], best), frame.steepest = at[worst];
  int axis = 0;
  best.cwiseAbs().minCoeff(&axis);
  Vec3 along(0, 0, 0);
  along[axis] = 1;
  frame.u = cross(along, best);
  frame.u /= norm(frame.u);
  frame.v = cross(best, frame.u);
  return frame;
}

}  // namespace carreau::atlas
