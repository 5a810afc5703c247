// SPDX-License-Identifier: BSD-3-Clause
// The generalised Delaunay kernel: a cavity is dug about a new point and filled with a star of triangles.
#include <algorithm>
#include <cmath>

#include "plane/kernel/thresholds.h"
#include "plane/kernel/triangulation.h"
#include "predicates/predicates.h"
#include "support/rounding_of.h"

namespace carreau::plane {

namespace {

// Sign of cross(p, q), decided by its rounding errors: p and q are rounded differences of coordinates ([shewchuk-1997]
// sec. 4.3); 0: the exact predicate must decide.
inline int sign_of_cross(double px, double py, double qx, double qy, double& value) noexcept {
  const double left = px * qy, right = py * qx;
  value = left - right;
  const double bound = detail::orientation_bound * (std::abs(left) + std::abs(right)) + detail::underflow_bound;
  return value > bound ? 1 : value < -bound ? -1 : 0;
}

inline double squared(Metric2 m, double x, double y) noexcept { return (m.a * x + 2 * m.b * y) * x + m.c * y * y; }

}  // namespace

bool Triangulation::too_near(const Vec2& p, int v, double d2, const InsertRules& rules, bool in_chart) const noexcept {
  if (std::find(rules.exempt.begin(), rules.exempt.end(), v) != rules.exempt.end()) return false;
  if (in_chart) return true;
  const Vertex& w = vertices[v];
  // The mean of both ends decides: a metric that varies would otherwise reject from one side an edge that it accepts
  // from the other.
  return 0.5 * (d2 + squared(w.metric(), w.x - p.x(), w.y - p.y())) < rules.distance2;
}

// True if the new point lies in the circle through a, d, b, which are all far from it, in the mean of their metrics and
// its metric: opposite angles sum to more than pi. sum is the area of a, d, p and d, b, p together.
bool Triangulation::in_far_circle(const Metric2& metric, const RimPoint& a, const RimPoint& b, const RimPoint& d, double sum,
                                  double area) const noexcept {
  const Metric2 m = metric + vertices[a.v].metric() + vertices[b.v].metric() + vertices[d.v].metric();
  const Vec2 pa{a.x, a.y}, pb{b.x, b.y}, pd{d.x, d.y};
  return dot(m, pa, pb) * (sum - area) + dot(m, pa - pd, pb - pd) * area < 0;
}

// The circle through p, a, b and d in the chart of p.
bool Triangulation::in_circle_of_chart(std::int32_t a, std::int32_t b, std::int32_t d) const noexcept {
  const Vec2 A = charted_[a], B = charted_[b], D = charted_[d];
  const double ab = cross(A, B), d2 = points_[d].d2;
  return points_[a].d2 * cross(D, B) + points_[b].d2 * cross(A, D) - d2 * ab > rounding_of::heights * d2 * std::abs(ab);
}

void Triangulation::reserve_cavity(std::size_t triangles_in) {
  if (points_.size() >= triangles_in + 8) return;
  const std::size_t n = 2 * triangles_in + 64;
  cavity_.resize(n);
  points_.resize(n);
  charted_.resize(n);
  rim_.resize(n);
  stack_.resize(n);
}

// alpha < 1 in RR-2928 eq. 5-8. If all are near to p, one metric replaces the product of four; farther away the mean
// tensor of the four vertices does (README, "Differs").
bool Triangulation::dig(Vec2 p, Metric2 metric, int start, const InsertRules& rules, const Chart* chart) {
  return chart != nullptr ? dig_in<true>(p, metric, start, rules, chart)
                          : dig_in<false>(p, metric, start, rules, chart);
}

template <bool charted>
bool Triangulation::dig_in(Vec2 p, Metric2 metric, int start, const InsertRules& rules,
                           [[maybe_unused]] const Chart* chart) {
  reserve_cavity(64);
  const Triangle& S = triangles[start];
  std::size_t cavity_size = 0, rim_size = 0, top = 0, point_count = 3;
  for (int i = 0; i < 3; ++i) {
    const Vertex& w = vertices[S.v[i]];
    const double x = w.x - p.x(), y = w.y - p.y();
    if constexpr (charted) charted_[i] = chart->at_offset({x, y});
    const double d2 = charted ? dot(charted_[i], charted_[i]) : squared(metric, x, y);
    if ((x == 0 && y == 0) || (d2 < rules.distance2 && too_near(p, S.v[i], d2, rules, charted))) return false;
    points_[i] = {x, y, d2, S.v[i]};
  }
  cavity_[cavity_size++] = start;
  for (int i = 2; i >= 0; --i) {
    const int a = next3[i], b = prev3[i];
    double area;
    int sign = sign_of_cross(points_[a].x, points_[a].y, points_[b].x, points_[b].y, area);
    if (sign == 0) sign = orientation(at(S.v[a]), at(S.v[b]), p);
    const bool imposed = (S.imposed >> i & 1) != 0;
    if (sign <= 0 && (imposed || S.n[i] == no_edge)) return false;
    stack_[top++] = {
        a,         b,   S.n[i], static_cast<std::uint8_t>(imposed), static_cast<std::uint8_t>(S.degenerate >> i & 1),
        sign <= 0, area};
  }
  RimPoint* points = points_.data();
  RimEdge *stack = stack_.data(), *rim = rim_.data();
  while (top > 0) {
    RimEdge& e = stack[top - 1];
    const RimPoint &A = points[e.a], &B = points[e.b];
    if (e.imposed == 0 && e.outside != no_edge) {
      const int t = e.outside >> 2, i = e.outside & 3;
      const Triangle& N = triangles[t];
      const Vertex& w = vertices[N.v[i]];
      RimPoint& D = points[point_count];
      D.x = w.x - p.x(), D.y = w.y - p.y(), D.v = N.v[i];
      D.d2 = squared(metric, D.x, D.y);
      const auto d = static_cast<std::int32_t>(point_count);
      if constexpr (charted) {
        charted_[d] = chart->at_offset({D.x, D.y});
        D.d2 = dot(charted_[d], charted_[d]);
      }
      double ad, db;
      int left = sign_of_cross(A.x, A.y, D.x, D.y, ad), right = sign_of_cross(D.x, D.y, B.x, B.y, db);
      if (left >= 0 && right >= 0) {
        bool inside = charted ? in_circle_of_chart(e.a, e.b, d)
                              : A.d2 * db + B.d2 * ad - D.d2 * e.area > rounding_of::heights * D.d2 * e.area;
        if (std::max({A.d2, B.d2, D.d2}) > near2) {
          const bool near_a = A.d2 <= near2, near_b = B.d2 <= near2;
          if (D.d2 <= near2)
            inside = true;  // a sliver between a near and a far vertex
          else if (near_a && near_b)
            inside = inside &&
                     (charted ? dot(charted_[e.a], charted_[e.b]) : dot(metric, Vec2{A.x, A.y}, Vec2{B.x, B.y})) < 0;
          else if (!near_a && !near_b)
            inside = in_far_circle(metric, A, B, D, ad + db, e.area);
        }
        if (inside || e.crossed) {
          if (left == 0) left = orientation(at(A.v), w.point(), p);
          if (right == 0) right = orientation(w.point(), at(B.v), p);
          if (left > 0 && right > 0) {
            if (D.d2 < rules.distance2 && too_near(p, D.v, D.d2, rules, charted)) return false;
            cavity_[cavity_size++] = t;
            ++point_count;
            const int ia = next3[i], ib = prev3[i];  // corner ia is b, corner ib is a
            const std::int32_t a = e.a;
            // The second of the two new edges takes the place of e.
            e.a = d, e.outside = N.n[ib], e.crossed = false, e.area = db;
            e.imposed = static_cast<std::uint8_t>(N.imposed >> ib & 1);
            e.degenerate = static_cast<std::uint8_t>(N.degenerate >> ib & 1);
            stack[top++] = {a,
                            d,
                            N.n[ia],
                            static_cast<std::uint8_t>(N.imposed >> ia & 1),
                            static_cast<std::uint8_t>(N.degenerate >> ia & 1),
                            false,
                            ad};
            if (point_count + 8 > points_.size()) {
              reserve_cavity(2 * point_count);
              points = points_.data(), stack = stack_.data(), rim = rim_.data();
            }
            continue;
          }
        }
      }
    }
    if (e.crossed) return false;
    if (e.imposed != 0 && (rules.height > 0 || e.degenerate != 0)) {
      const double det = std::max(determinant(metric), 0.0), l2 = squared(metric, B.x - A.x, B.y - A.y);
      const double least2 = e.degenerate != 0 ? rules.degenerate_height * rules.degenerate_height
                                              : rules.height * rules.height * std::min(l2, 1.0);
      if (e.area * e.area * det < least2 * l2) return false;
    }
    rim[rim_size++] = e;
    --top;
  }
  cavity_size_ = cavity_size, rim_size_ = rim_size;
  return true;
}

void Triangulation::fill(int p) {
  const int k = static_cast<int>(rim_size_);
  while (cavity_size_ < rim_size_) {
    cavity_[cavity_size_++] = static_cast<std::int32_t>(triangles.size());
    triangles.emplace_back();
  }
  // Plain addresses: for the compiler, bytes written could be a part of the vectors themselves.
  Triangle* const all = triangles.data();
  Vertex* const all_vertices = vertices.data();
  const RimEdge* const rim = rim_.data();
  const RimPoint* const points = points_.data();
  const std::int32_t* const star = cavity_.data();
  int s = star[0], before = star[k - 1];
  for (int i = 0; i < k; ++i) {
    const RimEdge& e = rim[i];
    const int after = star[i + 1 < k ? i + 1 : 0];
    const std::int32_t a = points[e.a].v;
    Triangle& T = all[s];
    T.v[0] = p, T.v[1] = a, T.v[2] = points[e.b].v;
    T.n[0] = e.outside, T.n[1] = 4 * after + 2, T.n[2] = 4 * before + 1;
    T.imposed = e.imposed;
    T.degenerate = e.degenerate;
    T.done = Done::no;
    if (e.outside != no_edge) all[e.outside >> 2].n[e.outside & 3] = 4 * s;
    all_vertices[a].triangle = s;
    before = s, s = after;
  }
  vertices[p].triangle = star[0];
}

}  // namespace carreau::plane
