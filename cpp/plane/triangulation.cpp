#include "plane/triangulation.h"

#include <algorithm>
#include <cmath>

#include "predicates/predicates.h"

namespace carreau::plane {

namespace {

// Vertices farther than this from the new point are judged in the mean of the metrics concerned: that of the point
// alone says nothing about so distant a place.
constexpr double near2 = 9;

double metric_dot(double a, double b, double c, double ux, double uy, double vx, double vy) noexcept {
  return a * ux * vx + b * (ux * vy + uy * vx) + c * uy * vy;
}

}  // namespace

Factor::Factor(Metric2 m) noexcept {
  p = std::sqrt(m.a);
  q = m.b / p;
  r = std::sqrt(std::max(m.c - q * q, 1e-12 * m.c));
}

int Triangulation::locate(Vec2 p, int hint, bool cross_imposed) const noexcept {
  int t = hint, from = -1;
  std::uint32_t turn = 0;
  const std::size_t limit = 2 * triangles.size() + 100;
  for (std::size_t step = 0; step < limit; ++step) {
    const Triangle& T = triangles[t];
    // In a triangulation that is not Delaunay a fixed order can go round in circles.
    turn = turn * 1664525U + 1013904223U;
    const int first = step < 30 ? 0 : static_cast<int>((turn >> 16) % 3);
    bool moved = false, blocked = false;
    for (int k = 0; k < 3; ++k) {
      const int i = (first + k) % 3;
      if (i == from) continue;
      if (orientation(at(T.v[next3[i]]), at(T.v[prev3[i]]), p) >= 0) continue;
      if (T.n[i] == no_edge || (!cross_imposed && (T.imposed >> i & 1) != 0)) {
        blocked = true;
        continue;
      }
      from = T.n[i] & 3;
      t = T.n[i] >> 2;
      moved = true;
      break;
    }
    if (!moved) return blocked ? -1 : t;
  }
  return -1;
}

double Triangulation::squared_length(int u, int v) const noexcept {
  const Vertex &P = vertices[u], &Q = vertices[v];
  const double dx = Q.x - P.x, dy = Q.y - P.y;
  return 0.5 * ((P.a + Q.a) * dx * dx + 2.0 * (P.b + Q.b) * dx * dy + (P.c + Q.c) * dy * dy);
}

double Triangulation::squared_radius(int t) const noexcept {
  const Triangle& T = triangles[t];
  const Vertex &A = vertices[T.v[0]], &B = vertices[T.v[1]], &C = vertices[T.v[2]];
  const double a = (static_cast<double>(A.a) + B.a + C.a) / 3, b = (static_cast<double>(A.b) + B.b + C.b) / 3,
               c = (static_cast<double>(A.c) + B.c + C.c) / 3;
  const double ux = B.x - A.x, uy = B.y - A.y, vx = C.x - A.x, vy = C.y - A.y, wx = ux - vx, wy = uy - vy;
  const double area = ux * vy - uy * vx;
  return metric_dot(a, b, c, ux, uy, ux, uy) * metric_dot(a, b, c, vx, vy, vx, vy) *
         metric_dot(a, b, c, wx, wy, wx, wy) / (4 * area * area * std::max(a * c - b * b, 1e-300));
}

bool Triangulation::dig(Vec2 p, Metric2 metric, int start, const InsertRules& rules) {
  const Factor factor(metric);
  cavity_.clear();
  rim_.clear();
  stack_.clear();
  const double refuse2 = rules.least_distance2;
  const auto too_near = [&](const Vertex& w, double d2) {
    if (d2 >= refuse2) return false;
    const double dx = w.x - p.x, dy = w.y - p.y;
    // Both ends must agree: a metric that varies would refuse on one side what it wants on the other.
    return 0.5 * (d2 + metric_dot(w.a, w.b, w.c, dx, dy, dx, dy)) < refuse2;
  };
  const Triangle& S = triangles[start];
  double X[3], Y[3];
  for (int i = 0; i < 3; ++i) {
    const Vertex& w = vertices[S.v[i]];
    factor.apply(w.x - p.x, w.y - p.y, X[i], Y[i]);
    if (too_near(w, X[i] * X[i] + Y[i] * Y[i])) return false;
  }
  cavity_.push_back(start);
  for (int i = 2; i >= 0; --i) {
    const int a = next3[i], b = prev3[i];
    stack_.push_back({S.v[a], S.v[b], S.n[i], static_cast<std::uint8_t>(S.imposed >> i & 1),
                      static_cast<std::uint8_t>(S.degenerate >> i & 1), X[a], Y[a], X[b], Y[b]});
  }
  while (!stack_.empty()) {
    const RimEdge e = stack_.back();
    stack_.pop_back();
    const bool on_edge = stack_.size() < 3 && orientation(at(e.a), at(e.b), p) == 0;
    if (on_edge && (e.imposed != 0 || e.outside == no_edge)) return false;
    if (e.imposed == 0 && e.outside != no_edge) {
      const int t = e.outside >> 2, i = e.outside & 3;
      const Triangle& N = triangles[t];
      const int d = N.v[i];
      const Vertex& w = vertices[d];
      double dx, dy;
      factor.apply(w.x - p.x, w.y - p.y, dx, dy);
      const double d2 = dx * dx + dy * dy;
      const double ad = e.ax * dy - e.ay * dx, db = dx * e.by - dy * e.bx, ab = e.ax * e.by - e.ay * e.bx;
      bool inside;
      const double a2 = e.ax * e.ax + e.ay * e.ay, b2 = e.bx * e.bx + e.by * e.by;
      if (d2 <= near2 || a2 <= near2 || b2 <= near2) {
        inside = a2 * db + b2 * ad - d2 * ab > 1e-12 * d2 * (std::abs(ab) + 1e-300);
      } else {
        const Vertex &A = vertices[e.a], &B = vertices[e.b];
        const double ma = metric.a + A.a + B.a + w.a, mb = metric.b + A.b + B.b + w.b, mc = metric.c + A.c + B.c + w.c;
        const double pax = A.x - p.x, pay = A.y - p.y, pbx = B.x - p.x, pby = B.y - p.y;
        const double dax = A.x - w.x, day = A.y - w.y, dbx = B.x - w.x, dby = B.y - w.y;
        inside = metric_dot(ma, mb, mc, pax, pay, pbx, pby) * (dbx * day - dby * dax) +
                     metric_dot(ma, mb, mc, dax, day, dbx, dby) * (pax * pby - pay * pbx) <
                 0;
      }
      if ((on_edge || inside) && orientation(p, at(e.a), w.point()) > 0 && orientation(p, w.point(), at(e.b)) > 0) {
        if (too_near(w, d2)) return false;
        cavity_.push_back(t);
        const int ia = next3[i], ib = prev3[i];  // corner ia is b, corner ib is a
        stack_.push_back({d, e.b, N.n[ib], static_cast<std::uint8_t>(N.imposed >> ib & 1),
                          static_cast<std::uint8_t>(N.degenerate >> ib & 1), dx, dy, e.bx, e.by});
        stack_.push_back({e.a, d, N.n[ia], static_cast<std::uint8_t>(N.imposed >> ia & 1),
                          static_cast<std::uint8_t>(N.degenerate >> ia & 1), e.ax, e.ay, dx, dy});
        continue;
      }
      if (on_edge) return false;
    }
    if (e.imposed != 0 && (rules.least_height > 0 || e.degenerate != 0)) {
      const double ex = e.bx - e.ax, ey = e.by - e.ay, l2 = ex * ex + ey * ey, area = e.ax * e.by - e.ay * e.bx;
      const double least2 = e.degenerate != 0 ? rules.least_degenerate_height * rules.least_degenerate_height * l2
                                              : rules.least_height * rules.least_height * l2 * std::min(l2, 1.0);
      if (area * area < least2) return false;
    }
    rim_.push_back(e);
  }
  return true;
}

void Triangulation::fill(int p) {
  const int k = static_cast<int>(rim_.size());
  while (static_cast<int>(cavity_.size()) < k) {
    cavity_.push_back(static_cast<std::int32_t>(triangles.size()));
    triangles.emplace_back();
  }
  for (int i = 0; i < k; ++i) {
    const RimEdge& e = rim_[i];
    const int s = cavity_[i], after = cavity_[i + 1 < k ? i + 1 : 0], before = cavity_[i > 0 ? i - 1 : k - 1];
    Triangle& T = triangles[s];
    T.v[0] = p, T.v[1] = e.a, T.v[2] = e.b;
    T.n[0] = e.outside, T.n[1] = 4 * after + 2, T.n[2] = 4 * before + 1;
    T.imposed = e.imposed;
    T.degenerate = e.degenerate;
    T.done = 0;
    if (e.outside != no_edge) triangles[e.outside >> 2].n[e.outside & 3] = 4 * s;
    vertices[e.a].triangle = s;
  }
  vertices[p].triangle = cavity_[0];
}

bool Triangulation::insert(Vec2 p, Metric2 metric, int start, const InsertRules& rules) {
  if (!dig(p, metric, start, rules)) return false;
  vertices.push_back(
      {p.x, p.y, static_cast<float>(metric.a), static_cast<float>(metric.b), static_cast<float>(metric.c), -1});
  fill(static_cast<int>(vertices.size()) - 1);
  return true;
}

bool Triangulation::can_swap(int t, int i) const noexcept {
  const Triangle& A = triangles[t];
  if (A.n[i] == no_edge || (A.imposed >> i & 1) != 0) return false;
  const Triangle& B = triangles[A.n[i] >> 2];
  const Vec2 c = at(A.v[i]), a = at(A.v[next3[i]]), b = at(A.v[prev3[i]]), d = at(B.v[A.n[i] & 3]);
  return orientation(c, a, d) > 0 && orientation(c, d, b) > 0;
}

void Triangulation::swap_edge(int t, int i) noexcept {
  Triangle& A = triangles[t];
  const int u = A.n[i] >> 2, j = A.n[i] & 3;
  Triangle& B = triangles[u];
  const auto bit = [](std::uint8_t bits, int k) { return static_cast<unsigned>(bits >> k & 1); };
  const int c = A.v[i], a = A.v[next3[i]], b = A.v[prev3[i]], d = B.v[j];
  // Outer edges: bc and ca of A; ad and db of B (B is d, b, a from corner j).
  const HalfEdge bc = A.n[next3[i]], ca = A.n[prev3[i]], ad = B.n[next3[j]], db = B.n[prev3[j]];
  const auto pack = [&](unsigned e0, unsigned e1, unsigned e2) {
    return static_cast<std::uint8_t>(e0 | e1 << 1 | e2 << 2);
  };
  const std::uint8_t a_imposed = pack(bit(B.imposed, next3[j]), 0, bit(A.imposed, prev3[i]));
  const std::uint8_t b_imposed = pack(bit(B.imposed, prev3[j]), bit(A.imposed, next3[i]), 0);
  const std::uint8_t a_degenerate = pack(bit(B.degenerate, next3[j]), 0, bit(A.degenerate, prev3[i]));
  const std::uint8_t b_degenerate = pack(bit(B.degenerate, prev3[j]), bit(A.degenerate, next3[i]), 0);
  A.v[0] = c, A.v[1] = a, A.v[2] = d;
  A.n[0] = ad, A.n[1] = 4 * u + 2, A.n[2] = ca;
  B.v[0] = c, B.v[1] = d, B.v[2] = b;
  B.n[0] = db, B.n[1] = bc, B.n[2] = 4 * t + 1;
  A.imposed = a_imposed, B.imposed = b_imposed, A.degenerate = a_degenerate, B.degenerate = b_degenerate;
  if (ad != no_edge) triangles[ad >> 2].n[ad & 3] = 4 * t;
  if (ca != no_edge) triangles[ca >> 2].n[ca & 3] = 4 * t + 2;
  if (db != no_edge) triangles[db >> 2].n[db & 3] = 4 * u;
  if (bc != no_edge) triangles[bc >> 2].n[bc & 3] = 4 * u + 1;
  vertices[c].triangle = vertices[a].triangle = vertices[d].triangle = t;
  vertices[b].triangle = u;
}

}  // namespace carreau::plane
