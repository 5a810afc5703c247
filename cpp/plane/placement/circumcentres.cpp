// Points that no front places: on long edges (algebraic placement), at circumcentres of triangles left too large.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane/placement/distances.h"
#include "plane/placement/filler.h"

namespace carreau::plane {

namespace {

constexpr int attempts = 4;
// Of points on edges that join what is far apart: crowded ones are removed in the end, but edges that cannot be swapped
// would stay.
constexpr double crowded_distance = 0.25;
// 1 % of points more where the radius is less by 0.045, but never as small as that of many that rows make. Edges about
// a larger radius become longer than 1.5.
constexpr double radius_a_share = 4.5, largest_reduction = 0.1, largest_rise = 0.05;
static_assert(leftover_radius - largest_reduction > done_radius);
constexpr int most_pieces = 4096;  // of one edge in one pass; the next passes see to the rest

}  // namespace

double Filler::distance_at_middle(Vec2 p, Vec2 q) const { return length(field_.at(0.5 * (p + q)), q - p); }

Vec2 Filler::circumcentre(int t) const {
  const Triangle& T = mesh_.triangles[t];
  const auto from_corner = [](Metric2 m, Vec2 u, Vec2 v) -> Vec2 {
    const double uu = dot(m, u, u), vv = dot(m, v, v), uv = dot(m, u, v), det = 2 * (uu * vv - uv * uv);
    return (vv * (uu - uv) / det) * u + (uu * (vv - uv) / det) * v;
  };
  const Vertex &A = mesh_.vertices[T.v[0]], &B = mesh_.vertices[T.v[1]], &C = mesh_.vertices[T.v[2]];
  if (shapes_.is_bent(T)) {
    const ChartedTriangle y = shapes_.charted(T);
    const Vec2 middle = (1.0 / 3) * (A.point() + B.point() + C.point());
    return y.chart.point(y.a + from_corner({}, y.b - y.a, y.c - y.a), middle);
  }
  const Metric2 m = (1.0 / 3) * (A.metric() + B.metric() + C.metric());
  return A.point() + from_corner(m, B.point() - A.point(), C.point() - A.point());
}

// Long edges of a bent triangle, which mean tensors or charts beyond their reach have joined, are swapped for shorter
// ones.
bool Filler::shorten(int t) {
  constexpr double gain = 0.9;
  const Triangle& T = mesh_.triangles[t];
  if (!shapes_.is_bent(T)) return false;
  for (int i = 0; i < 3; ++i) {
    const double l2 = shapes_.squared_length(T.v[next3[i]], T.v[prev3[i]]);
    if (l2 <= longest_bent2 || !mesh_.can_swap(t, i)) continue;
    const HalfEdge o = T.n[i];
    if (shapes_.squared_length(T.v[i], mesh_.triangles[o >> 2].v[o & 3]) > gain * gain * l2) continue;
    mesh_.swap_edge(t, i);
    mesh_.triangles[t].done = mesh_.triangles[o >> 2].done = Done::no;
    return true;
  }
  return false;
}

// A point on the longest edge of a bent triangle, if that is long.
bool Filler::halve(int t) {
  const Triangle& T = mesh_.triangles[t];
  if (!shapes_.is_bent(T)) return false;
  const Lengths l = shapes_.lengths(T.v[0], T.v[1], T.v[2]);
  const int i = l.a >= l.b && l.a >= l.c ? 0 : l.b >= l.c ? 1 : 2;
  if (std::max({l.a, l.b, l.c}) <= longest_bent2) return false;
  return fill_at(0.5 * (mesh_.at(T.v[next3[i]]) + mesh_.at(T.v[prev3[i]])), t, crowded_distance);
}

bool Filler::fill_at(Vec2 p, int t, double distance) {
  const int start = is_finite(p) ? mesh_.locate(p, t) : -1;
  return start >= 0 && try_insert(p, start, distance, imposed_height);
}

// Rows that must gain points all along make too few, those that must lose them too many. Where sizes are graded, what
// is missing of the expected number lowers the radius that asks for a point, what is too many raises it.
double Filler::graded_radius(double radius) const {
  if (shapes_.classify() != Sizes::graded) return radius;
  const double missing = 1 - static_cast<double>(mesh_.triangles.size()) / std::max(field_.measure(), 1.0);
  return radius - std::clamp(radius_a_share * missing, -largest_rise, largest_reduction);
}

void Filler::fill_leftovers(double radius, double distance) {
  const double graded = graded_radius(radius);
  const double radius2 = radius * radius, graded2 = graded * graded;
  for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t) {
    tick();
    // Those that are done, nearly all, have a smaller radius.
    for (int attempt = 0; attempt < attempts && mesh_.triangles[t].done == Done::no; ++attempt) {
      const double r2 = shapes_.squared_radius(t);
      if (!(r2 > (shapes_.change(t) > graded_change ? graded2 : radius2))) break;
      if (!shorten(t) && !fill_at(circumcentre(t), t, distance) && !halve(t)) break;
    }
  }
  touched_.clear();
}

void Filler::split_long_edges() {
  judge_all();
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
