// Points that no front places: on long edges (algebraic placement), at circumcentres of triangles left too large.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane/filler.h"
#include "plane/placement.h"

namespace carreau::plane {

namespace {

constexpr int attempts = 4;
constexpr int most_pieces = 4096;  // of one edge in one pass; the next passes see to the rest

}  // namespace

double Filler::distance_at_middle(Vec2 p, Vec2 q) const { return length(field_.at(0.5 * (p + q)), q - p); }

Vec2 Filler::circumcentre(int t) const {
  const Triangle& T = mesh_.triangles[t];
  const Vertex &A = mesh_.vertices[T.v[0]], &B = mesh_.vertices[T.v[1]], &C = mesh_.vertices[T.v[2]];
  const Metric2 m = (1.0 / 3) * (A.metric() + B.metric() + C.metric());
  const Vec2 u = B.point() - A.point(), v = C.point() - A.point();
  const double uu = dot(m, u, u), vv = dot(m, v, v), uv = dot(m, u, v), det = 2 * (uu * vv - uv * uv);
  return A.point() + (vv * (uu - uv) / det) * u + (uu * (vv - uv) / det) * v;
}

void Filler::fill_leftovers(double radius, double distance) {
  const double radius2 = radius * radius;
  for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t) {
    tick();
    for (int attempt = 0; attempt < attempts; ++attempt) {
      if (mesh_.triangles[t].done == Done::frozen || !(mesh_.squared_radius(t) > radius2)) break;
      const Vec2 centre = circumcentre(t);
      if (!is_finite(centre)) break;
      const int start = mesh_.locate(centre, t);
      if (start < 0 || !try_insert(centre, start, distance, imposed_height)) break;
    }
  }
  touched_.clear();
}

void Filler::split_long_edges() {
  for (;;) {
    row_.clear();
    for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t) {
      tick();
      const Triangle& T = mesh_.triangles[t];
      for (int i = 0; i < 3; ++i) {
        const HalfEdge other = T.n[i];
        if (other == no_edge || (other >> 2) < t || (T.imposed >> i & 1) != 0) continue;
        const int a = T.v[next3[i]], b = T.v[prev3[i]];
        const Vec2 p = mesh_.at(a), q = mesh_.at(b);
        // Simpson's rule for the integral of RR-2928 sec. 2.2, "Longueur d'un segment".
        const double l = (length(mesh_.vertices[a].metric(), q - p) + 4 * distance_at_middle(p, q) +
                          length(mesh_.vertices[b].metric(), q - p)) /
                         6;
        if (!(l > std::numbers::sqrt2)) continue;
        const int pieces = std::max(2, static_cast<int>(std::min(l + 0.5, static_cast<double>(most_pieces))));
        for (int k = 1; k < pieces; ++k)
          row_.push_back({lerp(p, q, static_cast<double>(k) / pieces), {}, 4 * t + i, static_cast<std::int32_t>(a)});
      }
    }
    const std::size_t before = mesh_.vertices.size();
    for (const Candidate& c : row_) {
      const int t = mesh_.locate(c.p, start_of(c));
      if (t >= 0) try_insert(c.p, t, 0.7, imposed_height);
    }
    touched_.clear();
    if (mesh_.vertices.size() == before) break;
  }
  fill_leftovers(leftover_radius, 0.7);
}

}  // namespace carreau::plane
