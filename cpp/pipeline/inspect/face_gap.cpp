// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/inspect/face_gap.h"

#include <algorithm>
#include <optional>

#include "pipeline/base/thresholds.h"
#include "support/angles.h"
#include "support/rounding_of.h"

namespace carreau {

namespace {

using namespace thresholds::crossings;

/// One point on each face.
struct PointPair {
  OnFace p, q;
  [[nodiscard]] double distance() const { return norm(p.jet.s - q.jet.s); }
  [[nodiscard]] Vec3 middle() const { return 0.5 * (p.jet.s + q.jet.s); }
};

// The nearest point of the line that both tangent planes have, again and again. Empty: the planes are parallel, or a
// step leaves the triangles.
std::optional<PointPair> common_point(Cad& cad, const FaceTriangle& s, const FaceTriangle& t, PointPair pair) {
  const double longest = std::max(s.longest_edge(), t.longest_edge()), near = rounding_of::sizes * longest;
  for (int step = 0; step < rounding_of::newton_steps; ++step) {
    if (pair.distance() <= near) return pair;
    const auto& [p, q] = pair;
    const Vec3 line = cross(p.normal, q.normal), middle = pair.middle();
    const double c = dot(p.normal, q.normal), det = dot(line, line);
    if (!(det > angles::touching * angles::touching)) return {};
    const double a = dot(p.normal, p.jet.s - middle), b = dot(q.normal, q.jet.s - middle);
    const Vec3 x = middle + ((a - c * b) / det) * p.normal + ((b - c * a) / det) * q.normal;
    const Vec2 on_s = s.project(p, x), on_t = t.project(q, x);
    if (norm(s.nearest(on_s) - on_s) > near || norm(t.nearest(on_t) - on_t) > near) return {};
    pair = {s.evaluate(cad, on_s), t.evaluate(cad, on_t)};
  }
  return {};
}

PointPair nearest_points(Cad& cad, const FaceTriangle& s, const FaceTriangle& t, PointPair pair) {
  PointPair best = pair;
  for (int step = 0; step < projections; ++step) {
    pair.q = t.evaluate(cad, t.nearest(t.project(pair.q, pair.p.jet.s)));
    pair.p = s.evaluate(cad, s.nearest(s.project(pair.p, pair.q.jet.s)));
    if (!(pair.distance() < best.distance())) break;
    best = pair;
  }
  return best;
}

}  // namespace

FaceGap measure_gap(Cad& cad, const FaceTriangle& s, const FaceTriangle& t, const Vec3& place) {
  const auto over = [&](const FaceTriangle& of) { return of.evaluate(cad, of.nearest(of.position_of(place))); };
  const PointPair start{over(s), over(t)};
  FaceGap gap;
  gap.sagitta = std::max({norm(start.p.jet.s - place), norm(start.q.jet.s - place), s.sagitta(), t.sagitta()});
  if (const std::optional<PointPair> common = common_point(cad, s, t, start)) {
    gap.place = common->middle();
    return gap;
  }
  const PointPair nearest = nearest_points(cad, s, t, start);
  gap.width = nearest.distance();
  gap.slope = norm(cross(nearest.p.normal, nearest.q.normal));
  gap.place = nearest.middle();
  return gap;
}

}  // namespace carreau
