// The generalised Delaunay kernel: a cavity is dug about a new point and filled with a star of triangles.
#include <algorithm>
#include <cmath>

#include "plane/triangulation.h"
#include "predicates/predicates.h"

namespace carreau::plane {

namespace {

// Within this squared distance the metric of the new point speaks for the others.
constexpr double near2 = 9;
// Nearly cocircular points are left as they are: rounding must not dig.
constexpr double cocircular = 1e-12;

// Whether cross(p, q) is positive, decided by its rounding errors: p and q are rounded differences of coordinates
// ([shewchuk-1997] sec. 4.3); 0: the exact predicate must tell.
inline int sign_of_cross(double px, double py, double qx, double qy, double& value) noexcept {
  const double left = px * qy, right = py * qx;
  value = left - right;
  const double bound = detail::orientation_bound * (std::abs(left) + std::abs(right)) + detail::underflow_bound;
  return value > bound ? 1 : value < -bound ? -1 : 0;
}

inline double squared(Metric2 m, double x, double y) noexcept { return (m.a * x + 2 * m.b * y) * x + m.c * y * y; }

}  // namespace

bool Triangulation::too_near(Vec2 p, int v, double d2, const InsertRules& rules) const noexcept {
  if (std::find(rules.exempt.begin(), rules.exempt.end(), v) != rules.exempt.end()) return false;
  const Vertex& w = vertices[v];
  // Both ends must agree: a metric that varies would refuse on one side what it wants on the other.
  return 0.5 * (d2 + squared(w.metric(), w.x - p.x, w.y - p.y)) < rules.distance2;
}

// Whether p lies in the circle of the triangle beyond e, whose corner opposite to e is d: alpha < 1 in RR-2928 eq. 5-8.
// Where all is near to p one metric stands for the product of four; farther away the mean tensor of the four vertices
// does (README, "Differs").
bool Triangulation::wanted(const RimEdge& e, const Vertex& d, Metric2 metric, double dx, double dy, double d2,
                           double ad, double db) const noexcept {
  if (d2 <= near2 || e.a2 <= near2 || e.b2 <= near2)
    return e.a2 * db + e.b2 * ad - d2 * e.area > cocircular * d2 * e.area;
  const Vertex &A = vertices[e.a], &B = vertices[e.b];
  const Metric2 m = metric + A.metric() + B.metric() + d.metric();
  const Vec2 a{e.ax, e.ay}, b{e.bx, e.by}, w{dx, dy};
  return dot(m, a, b) * (ad + db - e.area) + dot(m, a - w, b - w) * e.area < 0;
}

bool Triangulation::dig(Vec2 p, Metric2 metric, int start, const InsertRules& rules) {
  cavity_.clear();
  rim_.clear();
  stack_.clear();
  const Triangle& S = triangles[start];
  double X[3], Y[3], D[3];
  for (int i = 0; i < 3; ++i) {
    const Vertex& w = vertices[S.v[i]];
    X[i] = w.x - p.x, Y[i] = w.y - p.y;
    D[i] = squared(metric, X[i], Y[i]);
    if ((X[i] == 0 && Y[i] == 0) || (D[i] < rules.distance2 && too_near(p, S.v[i], D[i], rules))) return false;
  }
  cavity_.push_back(start);
  for (int i = 2; i >= 0; --i) {
    const int a = next3[i], b = prev3[i];
    double area;
    int sign = sign_of_cross(X[a], Y[a], X[b], Y[b], area);
    if (sign == 0) sign = orientation(at(S.v[a]), at(S.v[b]), p);
    const bool imposed = (S.imposed >> i & 1) != 0;
    if (sign <= 0 && (imposed || S.n[i] == no_edge)) return false;
    stack_.push_back({S.v[a], S.v[b], S.n[i], static_cast<std::uint8_t>(imposed),
                      static_cast<std::uint8_t>(S.degenerate >> i & 1), sign <= 0, X[a], Y[a], X[b], Y[b], D[a], D[b],
                      area});
  }
  while (!stack_.empty()) {
    RimEdge& e = stack_.back();
    if (e.imposed == 0 && e.outside != no_edge) {
      const int t = e.outside >> 2, i = e.outside & 3;
      const Triangle& N = triangles[t];
      const int d = N.v[i];
      const Vertex& w = vertices[d];
      const double dx = w.x - p.x, dy = w.y - p.y, d2 = squared(metric, dx, dy);
      double ad, db;
      int left = sign_of_cross(e.ax, e.ay, dx, dy, ad), right = sign_of_cross(dx, dy, e.bx, e.by, db);
      if (left >= 0 && right >= 0 && (e.crossed || wanted(e, w, metric, dx, dy, d2, ad, db))) {
        if (left == 0) left = orientation(at(e.a), w.point(), p);
        if (right == 0) right = orientation(w.point(), at(e.b), p);
        if (left > 0 && right > 0) {
          if (d2 < rules.distance2 && too_near(p, d, d2, rules)) return false;
          cavity_.push_back(t);
          const int ia = next3[i], ib = prev3[i];  // corner ia is b, corner ib is a
          const RimEdge first{e.a,
                              d,
                              N.n[ia],
                              static_cast<std::uint8_t>(N.imposed >> ia & 1),
                              static_cast<std::uint8_t>(N.degenerate >> ia & 1),
                              false,
                              e.ax,
                              e.ay,
                              dx,
                              dy,
                              e.a2,
                              d2,
                              ad};
          // The second edge takes the place of e.
          e.a = d, e.outside = N.n[ib], e.crossed = false;
          e.imposed = static_cast<std::uint8_t>(N.imposed >> ib & 1);
          e.degenerate = static_cast<std::uint8_t>(N.degenerate >> ib & 1);
          e.ax = dx, e.ay = dy, e.a2 = d2, e.area = db;
          stack_.push_back(first);
          continue;
        }
      }
    }
    if (e.crossed) return false;
    if (e.imposed != 0 && (rules.height > 0 || e.degenerate != 0)) {
      const double det = std::max(determinant(metric), 0.0), l2 = squared(metric, e.bx - e.ax, e.by - e.ay);
      const double least2 = e.degenerate != 0 ? rules.degenerate_height * rules.degenerate_height
                                              : rules.height * rules.height * std::min(l2, 1.0);
      if (e.area * e.area * det < least2 * l2) return false;
    }
    rim_.push_back(e);
    stack_.pop_back();
  }
  return true;
}

void Triangulation::fill(int p) {
  const int k = static_cast<int>(rim_.size());
  while (static_cast<int>(cavity_.size()) < k) {
    cavity_.push_back(static_cast<std::int32_t>(triangles.size()));
    triangles.emplace_back();
  }
  Triangle* const all = triangles.data();
  const std::int32_t* const star = cavity_.data();
  for (int i = 0; i < k; ++i) {
    const RimEdge& e = rim_[i];
    const int s = star[i], after = star[i + 1 < k ? i + 1 : 0], before = star[i > 0 ? i - 1 : k - 1];
    Triangle& T = all[s];
    T.v[0] = p, T.v[1] = e.a, T.v[2] = e.b;
    T.n[0] = e.outside, T.n[1] = 4 * after + 2, T.n[2] = 4 * before + 1;
    T.imposed = e.imposed;
    T.degenerate = e.degenerate;
    T.done = Done::no;
    T.mark = 0;
    if (e.outside != no_edge) all[e.outside >> 2].n[e.outside & 3] = 4 * s;
    vertices[e.a].triangle = s;
  }
  vertices[p].triangle = star[0];
}

}  // namespace carreau::plane
