// SPDX-License-Identifier: BSD-3-Clause
#include "plane/placement/circumcentres.h"

#include <algorithm>
#include <cmath>

#include "plane/kernel/thresholds.h"

namespace carreau::plane {

namespace {

Vec2 circumcentre(const Placement& placement, int t) {
  const Triangulation& mesh = placement.mesh;
  const Triangle& T = mesh.triangles[t];
  const auto from_corner = [](Metric2 m, Vec2 u, Vec2 v) -> Vec2 {
    const double uu = dot(m, u, u), vv = dot(m, v, v), uv = dot(m, u, v), det = 2 * (uu * vv - uv * uv);
    return (vv * (uu - uv) / det) * u + (uu * (vv - uv) / det) * v;
  };
  const Vertex &A = mesh.vertices[T.v[0]], &B = mesh.vertices[T.v[1]], &C = mesh.vertices[T.v[2]];
  if (placement.shapes.is_bent(T)) {
    const ChartedTriangle y = placement.shapes.charted(T);
    const Vec2 middle = (1.0 / 3) * (A.point() + B.point() + C.point());
    return y.chart.point(y.a + from_corner({}, y.b - y.a, y.c - y.a), middle);
  }
  const Metric2 m = (1.0 / 3) * (A.metric() + B.metric() + C.metric());
  return A.point() + from_corner(m, B.point() - A.point(), C.point() - A.point());
}

// Long edges of a bent triangle, which mean tensors or charts beyond their reach have joined, are swapped for shorter
// ones.
bool shorten(Placement& placement, int t) {
  Triangulation& mesh = placement.mesh;
  const Shapes& shapes = placement.shapes;
  const Triangle& T = mesh.triangles[t];
  if (!shapes.is_bent(T)) return false;
  for (int i = 0; i < 3; ++i) {
    const double l2 = shapes.squared_length(T.v[next3[i]], T.v[prev3[i]]);
    if (l2 <= longest_bent2 || !mesh.can_swap(t, i)) continue;
    const HalfEdge o = T.n[i];
    if (shapes.squared_length(T.v[i], mesh.triangles[o >> 2].v[o & 3]) > shorter_edge * shorter_edge * l2) continue;
    mesh.swap_edge(t, i);
    mesh.triangles[t].done = mesh.triangles[o >> 2].done = Done::no;
    return true;
  }
  return false;
}

bool insert_near(Placement& placement, Vec2 p, int t, double distance) {
  // In a metric that is stretched a thousand times, the circumcentres of flat triangles lie at the
  // other end of the mesh, and no point is needed there. [Of 260 000 that gave a point none was 256 away: the examples, the CAD files at 2
  // %, 5 %, by angle and by direction]
  const int start = is_finite(p) ? placement.mesh.locate_near(p, t, 256) : -1;
  return start >= 0 && try_insert(placement, p, start, distance);
}

// A point on the longest edge of a bent triangle, if that is long.
bool halve(Placement& placement, int t) {
  const Triangulation& mesh = placement.mesh;
  const Triangle& T = mesh.triangles[t];
  if (!placement.shapes.is_bent(T)) return false;
  const Lengths l = placement.shapes.lengths(T.v[0], T.v[1], T.v[2]);
  const int i = l.a >= l.b && l.a >= l.c ? 0 : l.b >= l.c ? 1 : 2;
  if (std::max({l.a, l.b, l.c}) <= longest_bent2) return false;
  return insert_near(placement, 0.5 * (mesh.at(T.v[next3[i]]) + mesh.at(T.v[prev3[i]])), t, bent_edge_distance);
}

// Layers that must gain points all along make too few, layers that must lose points too many. In graded sizes, a lack
// against the expected number lowers the radius that requires a point, an excess raises it.
double graded_radius(const Placement& placement, double radius) {
  if (placement.shapes.classify() != Sizes::graded) return radius;
  const double missing =
      1 - static_cast<double>(placement.mesh.triangles.size()) / std::max(placement.field.measure(), 1.0);
  return radius - std::clamp(radius_a_share * missing, -largest_rise, largest_reduction);
}

}  // namespace

void insert_circumcentres(Placement& placement, double radius, double distance) {
  const Triangulation& mesh = placement.mesh;
  const Shapes& shapes = placement.shapes;
  const double graded = graded_radius(placement, radius);
  const double radius2 = radius * radius, graded2 = graded * graded;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    // The done ones, nearly all, have a smaller radius.
    if (mesh.triangles[k].done != Done::no) continue;
    const auto t = static_cast<int>(k);
    for (int attempt = 0; attempt < circumcentre_attempts && mesh.triangles[t].done == Done::no; ++attempt) {
      placement.tick();
      const double r2 = shapes.squared_radius(t);
      if (!(r2 > (shapes.change(t) > graded_change ? graded2 : radius2))) break;
      if (!shorten(placement, t) && !insert_near(placement, circumcentre(placement, t), t, distance) &&
          !halve(placement, t))
        break;
    }
  }
  placement.forget_touched();
}

}  // namespace carreau::plane
