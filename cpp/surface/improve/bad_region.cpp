// SPDX-License-Identifier: BSD-3-Clause
#include "surface/improve/bad_region.h"

#include <algorithm>
#include <utility>

#include "support/ranks/all_that_hold.h"

namespace carreau {

Vec3 unit_normal_in_space(const std::array<std::int32_t, 3>& t, const std::vector<Vec3>& xyz) noexcept {
  const Vec3 n = cross(xyz[t[1]] - xyz[t[0]], xyz[t[2]] - xyz[t[0]]);
  const double l = norm(n);
  return l > 0 ? (1 / l) * n : Vec3{0, 0, 0};
}

// Computes no roots for good triangles, which are nearly all.
bool is_below(double bound, const std::array<std::int32_t, 3>& t, const std::vector<Vec3>& xyz) {
  const Vec3 ab = xyz[t[1]] - xyz[t[0]], ac = xyz[t[2]] - xyz[t[0]], bc = ac - ab, n = cross(ab, ac);
  const double squares = dot(ab, ab) + dot(bc, bc) + dot(ac, ac), good = 1.001 * bound;
  return !(12 * dot(n, n) > good * good * squares * squares) && quality_in_space(t, xyz) < bound;
}

std::vector<std::int32_t> triangles_below(const PlaneMesh& mesh, const std::vector<Vec3>& xyz, double bound, const Executor& executor,
                                          Monitor& monitor) {
  return all_that_hold(mesh.triangles.size(), executor, "bad triangles", monitor,
                       [&](std::size_t t) { return is_below(bound, mesh.triangles[t], xyz); });
}

BadRegion::BadRegion(const PlaneDomain& domain, const PlaneMesh& mesh, const std::vector<Vec3>& xyz,
                     std::vector<std::int32_t> bad, int threads, Monitor& monitor)
    : mesh_(mesh), xyz_(xyz), triangles_(std::move(bad)) {
  const std::size_t n = mesh.triangles.size();
  if (triangles_.empty()) return;
  movable_.assign(mesh.vertices.size(), 0);
  for (int ring = 0; ring < 2; ++ring) {
    mark_corners(triangles_, movable_);
    triangles_ = all_that_hold(n, {nullptr, threads}, "", monitor, [&](std::size_t t) {
      const Triangle& c = mesh.triangles[t];
      return (movable_[c[0]] | movable_[c[1]] | movable_[c[2]]) != 0;
    });
  }
  std::fill_n(movable_.begin(), domain.vertices.size(), 0);
}

void BadRegion::mark_corners(const std::vector<std::int32_t>& triangles, std::vector<char>& marked) const {
  for (const std::int32_t t : triangles)
    for (const std::int32_t v : mesh_.triangles[t]) marked[v] = 1;
}

std::vector<std::int32_t> BadRegion::below(double bound) const {
  std::vector<std::int32_t> found;
  for (const std::int32_t t : triangles_)
    if (is_below(goals_.empty() ? bound : std::min<double>(bound, goals_[t]), mesh_.triangles[t], xyz_)) found.push_back(t);
  return found;
}

}  // namespace carreau
