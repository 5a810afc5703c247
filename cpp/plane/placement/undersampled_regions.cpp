// SPDX-License-Identifier: BSD-3-Clause
#include "plane/placement/undersampled_regions.h"

#include <cmath>
#include <numbers>

#include "metric/metric2_algebra.h"
#include "plane/kernel/thresholds.h"
#include "support/infinity.h"

namespace carreau::plane {

namespace {

// A walk can end at a hole: then from the nearest vertex.
int triangle_at(const Triangulation& mesh, const Vec2& p, int hint) {
  const int t = mesh.locate(p, hint);
  if (t >= 0) return t;
  int nearest = 0;
  double best = infinity;
  for (int v = 0; v < static_cast<int>(mesh.vertices.size()); ++v) {
    const Vec2 d = mesh.at(v) - p;
    if (dot(d, d) < best) best = dot(d, d), nearest = v;
  }
  return mesh.locate(p, mesh.vertices[nearest].triangle);
}

}  // namespace

bool seed_region(Placement& placement, Vec2 place, int& hint) {
  const Triangulation& mesh = placement.mesh;
  const int start = triangle_at(mesh, place, hint);
  if (start < 0) return false;
  hint = start;
  if (!try_insert(placement, place, start, seed_distance)) return false;
  const Eigen2 e = eigen(placement.field.at(place));
  const Vec2 base = (1 / std::sqrt(e.major)) * e.direction;
  const Vec2 height = (0.5 * std::numbers::sqrt3 / std::sqrt(e.minor)) * Vec2{-e.direction.y(), e.direction.x()};
  for (const Vec2& p : {Vec2(place + base), Vec2(place + 0.5 * base + height)}) {
    const int t = mesh.locate(p, mesh.vertices.back().triangle);
    if (t >= 0) try_insert(placement, p, t, layer_distance);
  }
  return true;
}

}  // namespace carreau::plane
