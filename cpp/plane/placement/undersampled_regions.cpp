// Places of small sizes that lie amid triangles whose vertices do not know of them.
#include <cmath>
#include <limits>
#include <numbers>

#include "metric/metric2_algebra.h"
#include "plane/placement/distances.h"
#include "plane/placement/filler.h"

namespace carreau::plane {

namespace {

// A point so far from all vertices is never wanted in a triangle that is small enough, nor in one that leftovers leave.
constexpr double far_from_all = 1;
static_assert(far_from_all > leftover_radius);

}  // namespace

// A walk can end at a hole: then from the nearest vertex.
int Filler::triangle_at(Vec2 p) const {
  const int t = mesh_.locate(p, mesh_.vertices.back().triangle);
  if (t >= 0) return t;
  int nearest = 0;
  double best = std::numeric_limits<double>::infinity();
  for (int v = 0; v < static_cast<int>(mesh_.vertices.size()); ++v) {
    const Vec2 d = mesh_.at(v) - p;
    if (dot(d, d) < best) best = dot(d, d), nearest = v;
  }
  return mesh_.locate(p, mesh_.vertices[nearest].triangle);
}

// The corners of a unit triangle at the place: rows march from its sides as from a boundary.
bool Filler::settle(Vec2 place) {
  const int start = triangle_at(place);
  if (start < 0 || !try_insert(place, start, far_from_all, imposed_height)) return false;
  const Eigen2 e = eigen(field_.at(place));
  const Vec2 base = (1 / std::sqrt(e.major)) * e.direction;
  const Vec2 height = (0.5 * std::numbers::sqrt3 / std::sqrt(e.minor)) * Vec2{-e.direction.y(), e.direction.x()};
  for (const Vec2& p : {Vec2(place + base), Vec2(place + 0.5 * base + height)}) {
    const int t = mesh_.locate(p, mesh_.vertices.back().triangle);
    if (t >= 0) try_insert(p, t, row_distance, imposed_height);
  }
  return true;
}

}  // namespace carreau::plane
