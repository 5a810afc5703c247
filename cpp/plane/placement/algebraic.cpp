// SPDX-License-Identifier: BSD-3-Clause
#include "plane/placement/algebraic.h"

#include <algorithm>
#include <numbers>

#include "plane/kernel/thresholds.h"
#include "plane/placement/circumcentres.h"

namespace carreau::plane {

namespace {

void place_on_edge(const Placement& placement, int t, int i, std::vector<Candidate>& points) {
  const Triangulation& mesh = placement.mesh;
  const Triangle& T = mesh.triangles[t];
  const std::int32_t a = T.v[next3[i]], b = T.v[prev3[i]];
  const Vec2 p = mesh.at(a), q = mesh.at(b);
  // Simpson's rule for the integral of RR-2928 sec. 2.2, "Longueur d'un segment".
  const double l = (length(mesh.vertices[a].metric(), q - p) + 4 * placement.field.length_at_middle(p, q) +
                    length(mesh.vertices[b].metric(), q - p)) /
                   6;
  if (!(l > std::numbers::sqrt2)) return;
  // On one edge in one pass, a bound of memory; the next passes see to the rest.
  const int pieces = std::max(2, static_cast<int>(std::min(l + 0.5, 4096.)));
  for (int k = 1; k < pieces; ++k) points.push_back({lerp(p, q, static_cast<double>(k) / pieces), {}, 4 * t + i, a});
}

}  // namespace

void split_long_edges(Placement& placement) {
  const Triangulation& mesh = placement.mesh;
  std::vector<Candidate> points;
  judge_all(placement);
  for (;;) {
    points.clear();
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
      placement.tick();
      const Triangle& T = mesh.triangles[t];
      for (int i = 0; i < 3; ++i)
        if (T.n[i] != no_edge && (T.n[i] >> 2) > t && (T.imposed >> i & 1) == 0) place_on_edge(placement, t, i, points);
    }
    const std::size_t before = mesh.vertices.size();
    for (const Candidate& c : points) try_insert(placement, c, point_distance);
    placement.forget_touched();
    if (mesh.vertices.size() == before) break;
  }
  insert_circumcentres(placement, large_radius, point_distance);
}

}  // namespace carreau::plane
