#include "plane/optimiser.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "predicates/predicates.h"

namespace carreau::plane {

namespace {

constexpr double swap_quality = 0.6;  // a swap for the sake of degrees leaves no triangle worse than this
constexpr double least_area = 0.2;    // of a parallelogram in the metric after a move (ideal: 0.87)
constexpr int undo_rounds = 20;
constexpr double worst_quality = 0.6;  // triangles below are attacked one by one

}  // namespace

Optimiser::Optimiser(Triangulation& mesh, int imposed, const ControlSpace& space, Monitor& monitor)
    : mesh_(mesh), imposed_(imposed), space_(space), monitor_(monitor) {}

void Optimiser::run(int sweeps) {
  swap_to_delaunay(10);
  swap_to_degree_six();
  for (int i = 0; i < sweeps; ++i) {
    monitor_.checkpoint();
    sweep();
  }
  monitor_.checkpoint();
  swap_to_delaunay(10);
  rescue_worst();
}

// The local Delaunay criterion in the mean metric of the four vertices: opposite angles sum to more than pi.
bool Optimiser::wants_swap(int t, int i) const {
  const Triangle& A = mesh_.triangles[t];
  const HalfEdge o = A.n[i];
  if (o == no_edge || (A.imposed >> i & 1) != 0) return false;
  const Triangle& B = mesh_.triangles[o >> 2];
  const Vertex &c = mesh_.vertices[A.v[i]], &a = mesh_.vertices[A.v[next3[i]]], &b = mesh_.vertices[A.v[prev3[i]]],
               &d = mesh_.vertices[B.v[o & 3]];
  const double ma = static_cast<double>(a.a) + b.a + c.a + d.a, mb = static_cast<double>(a.b) + b.b + c.b + d.b,
               mc = static_cast<double>(a.c) + b.c + c.c + d.c;
  const double cax = a.x - c.x, cay = a.y - c.y, cbx = b.x - c.x, cby = b.y - c.y, dax = a.x - d.x, day = a.y - d.y,
               dbx = b.x - d.x, dby = b.y - d.y;
  const double dot_c = ma * cax * cbx + mb * (cax * cby + cay * cbx) + mc * cay * cby;
  const double dot_d = ma * dax * dbx + mb * (dax * dby + day * dbx) + mc * day * dby;
  const double area_c = cax * cby - cay * cbx, area_d = dbx * day - dby * dax;
  const double s = dot_c * area_d + dot_d * area_c, scale = std::abs(dot_c) * area_d + std::abs(dot_d) * area_c;
  return s < -1e-9 * scale && mesh_.can_swap(t, i);
}

void Optimiser::swap_to_delaunay(int passes) {
  std::vector<std::int32_t> work, next;
  const auto total = static_cast<std::int64_t>(mesh_.triangles.size());
  std::int64_t swaps = 0;
  for (std::int32_t t = 0; t < total; ++t)
    for (int i = 0; i < 3; ++i) {
      if ((mesh_.triangles[t].n[i] >> 2) < t || !wants_swap(t, i)) continue;
      const int u = mesh_.triangles[t].n[i] >> 2;
      mesh_.swap_edge(t, i);
      work.push_back(t);
      work.push_back(u);
      if (++swaps > 20 * total) return;  // a metric that varies can make swaps run in circles
      break;
    }
  for (int pass = 0; pass < passes && !work.empty(); ++pass) {
    next.clear();
    for (const std::int32_t t : work)
      for (int i = 0; i < 3; ++i) {
        if (!wants_swap(t, i)) continue;
        const int u = mesh_.triangles[t].n[i] >> 2;
        mesh_.swap_edge(t, i);
        next.push_back(t);
        next.push_back(u);
        break;
      }
    work.swap(next);
  }
}

double Optimiser::quality(int p, int q, int r) const {
  const Vertex &P = mesh_.vertices[p], &Q = mesh_.vertices[q], &R = mesh_.vertices[r];
  const double area = (Q.x - P.x) * (R.y - P.y) - (Q.y - P.y) * (R.x - P.x);
  if (!(area > 0) || orientation(P.point(), Q.point(), R.point()) <= 0) return 0;
  const double a = static_cast<double>(P.a) + Q.a + R.a, b = static_cast<double>(P.b) + Q.b + R.b,
               c = static_cast<double>(P.c) + Q.c + R.c;
  const auto l2 = [&](const Vertex& s, const Vertex& e) {
    const double dx = e.x - s.x, dy = e.y - s.y;
    return a * dx * dx + 2 * b * dx * dy + c * dy * dy;
  };
  return 2 * std::numbers::sqrt3 * area * std::sqrt(std::max(a * c - b * b, 0.0)) / (l2(P, Q) + l2(Q, R) + l2(R, P));
}

void Optimiser::swap_to_degree_six() {
  degree_.assign(mesh_.vertices.size(), 0);
  wanted_degree_.assign(mesh_.vertices.size(), 6);
  std::vector<float> angle(imposed_, 0);
  std::vector<std::uint8_t> open(imposed_, 0);
  for (const Triangle& T : mesh_.triangles)
    for (int i = 0; i < 3; ++i) {
      ++degree_[T.v[i]];
      if (T.v[i] < imposed_) {
        const Vertex& P = mesh_.vertices[T.v[i]];
        const Vec2 u = mesh_.at(T.v[next3[i]]) - P.point(), v = mesh_.at(T.v[prev3[i]]) - P.point();
        const Metric2 m = P.metric();
        angle[T.v[i]] +=
            static_cast<float>(std::atan2(std::sqrt(std::max(determinant(m), 0.0)) * cross(u, v), dot(m, u, v)));
      }
      if (T.n[i] == no_edge) open[T.v[next3[i]]] = open[T.v[prev3[i]]] = 1;
    }
  // On the border a vertex of angle w wants w / 60 degrees triangles, and has one edge more than triangles: counted
  // alike, in triangles.
  for (int v = 0; v < imposed_; ++v)
    if (open[v] != 0)
      wanted_degree_[v] = static_cast<std::uint8_t>(std::max(1.0, std::floor(angle[v] / (std::numbers::pi / 3) + 0.5)));
  const auto excess = [&](int v) { return static_cast<int>(degree_[v]) - static_cast<int>(wanted_degree_[v]); };
  for (int pass = 0; pass < 2; ++pass) {
    bool any = false;
    for (std::int32_t t = 0; t < static_cast<std::int32_t>(mesh_.triangles.size()); ++t)
      for (int i = 0; i < 3; ++i) {
        const Triangle& A = mesh_.triangles[t];
        const HalfEdge o = A.n[i];
        if (o == no_edge || (o >> 2) < t || (A.imposed >> i & 1) != 0) continue;
        const int c = A.v[i], a = A.v[next3[i]], b = A.v[prev3[i]], d = mesh_.triangles[o >> 2].v[o & 3];
        // The sum of squares of the excesses changes by 2 (ec + ed - ea - eb) + 4.
        if (excess(c) + excess(d) - excess(a) - excess(b) + 2 >= 0) continue;
        if (quality(c, a, d) <= swap_quality || quality(c, d, b) <= swap_quality) continue;
        mesh_.swap_edge(t, i);
        --degree_[a], --degree_[b], ++degree_[c], ++degree_[d];
        any = true;
        break;
      }
    if (!any) break;
  }
}

bool Optimiser::sound(const Triangle& T) const {
  const Vertex &A = mesh_.vertices[T.v[0]], &B = mesh_.vertices[T.v[1]], &C = mesh_.vertices[T.v[2]];
  const double area = (B.x - A.x) * (C.y - A.y) - (B.y - A.y) * (C.x - A.x);
  const double a = static_cast<double>(A.a) + B.a + C.a, b = static_cast<double>(A.b) + B.b + C.b,
               c = static_cast<double>(A.c) + B.c + C.c;
  return area > 0 && area * area * (a * c - b * b) > 9 * least_area * least_area &&
         orientation(A.point(), B.point(), C.point()) > 0;
}

// Each triangle proposes to each of its vertices the place where it would be equilateral in the metric; each vertex
// goes to the mean of its proposals, all at once; moves that spoil a triangle are undone.
void Optimiser::sweep() {
  const auto n = static_cast<int>(mesh_.vertices.size());
  sum_x_.assign(n, 0);
  sum_y_.assign(n, 0);
  weight_.assign(n, 0);
  for (const Triangle& T : mesh_.triangles) {
    const Vertex* V[3] = {&mesh_.vertices[T.v[0]], &mesh_.vertices[T.v[1]], &mesh_.vertices[T.v[2]]};
    const double a = static_cast<double>(V[0]->a) + V[1]->a + V[2]->a,
                 b = static_cast<double>(V[0]->b) + V[1]->b + V[2]->b,
                 c = static_cast<double>(V[0]->c) + V[1]->c + V[2]->c;
    const double k = 0.5 * std::numbers::sqrt3 / std::sqrt(std::max(a * c - b * b, 1e-300));
    for (int i = 0; i < 3; ++i) {
      const Vertex &P = *V[next3[i]], &Q = *V[prev3[i]];
      const double ex = Q.x - P.x, ey = Q.y - P.y;
      const int v = T.v[i];
      sum_x_[v] += 0.5 * (P.x + Q.x) - k * (b * ex + c * ey);
      sum_y_[v] += 0.5 * (P.y + Q.y) + k * (a * ex + b * ey);
      weight_[v] += 1;
    }
  }
  old_.resize(n);
  for (int v = imposed_; v < n; ++v) {
    Vertex& P = mesh_.vertices[v];
    old_[v] = P.point();
    if (weight_[v] > 0) P.x = sum_x_[v] / weight_[v], P.y = sum_y_[v] / weight_[v];
  }
  for (int round = 0;; ++round) {
    bool any = false;
    for (const Triangle& T : mesh_.triangles) {
      if (sound(T)) continue;
      for (const std::int32_t v : T.v) {
        if (v < imposed_ || (mesh_.at(v) == old_[v])) continue;
        mesh_.vertices[v].x = old_[v].x;
        mesh_.vertices[v].y = old_[v].y;
        any = true;
      }
    }
    if (!any) break;
    if (round < undo_rounds) continue;
    for (int v = imposed_; v < n; ++v) mesh_.vertices[v].x = old_[v].x, mesh_.vertices[v].y = old_[v].y;
    break;
  }
  for (int v = imposed_; v < n; ++v) {
    Vertex& P = mesh_.vertices[v];
    if (P.point() == old_[v]) continue;
    const Metric2 m = space_.at(P.point());
    P.a = static_cast<float>(m.a), P.b = static_cast<float>(m.b), P.c = static_cast<float>(m.c);
  }
}

// A few triangles stay bad where rows met: swaps that raise the worse of two, then vertices moved to the best of a few
// places.
void Optimiser::rescue_worst() {
  std::vector<std::int32_t> ring;
  const auto worst_around = [&](int v) {
    double worst = 1;
    int t = mesh_.vertices[v].triangle;
    const int start = t;
    do {
      const Triangle& T = mesh_.triangles[t];
      worst = std::min(worst, quality(T.v[0], T.v[1], T.v[2]));
      const HalfEdge o = T.n[next3[mesh_.corner_of(t, v)]];
      if (o == no_edge) return -1.0;
      t = o >> 2;
    } while (t != start);
    return worst;
  };
  for (int pass = 0; pass < 3; ++pass) {
    bool any = false;
    for (std::int32_t t = 0; t < static_cast<std::int32_t>(mesh_.triangles.size()); ++t) {
      const Triangle& A = mesh_.triangles[t];
      const double q = quality(A.v[0], A.v[1], A.v[2]);
      if (q >= worst_quality) continue;
      for (int i = 0; i < 3; ++i) {
        if (!mesh_.can_swap(t, i)) continue;
        const HalfEdge o = mesh_.triangles[t].n[i];
        const Triangle &T = mesh_.triangles[t], &U = mesh_.triangles[o >> 2];
        const int c = T.v[i], a = T.v[next3[i]], b = T.v[prev3[i]], d = U.v[o & 3];
        const double before = std::min(q, quality(U.v[0], U.v[1], U.v[2]));
        if (std::min(quality(c, a, d), quality(c, d, b)) <= before + 1e-3) continue;
        mesh_.swap_edge(t, i);
        any = true;
        break;
      }
      for (const std::int32_t v : mesh_.triangles[t].v) {
        if (v < imposed_) continue;
        Vertex& P = mesh_.vertices[v];
        double best = worst_around(v);
        if (best < 0) continue;
        for (double step = 0.3; step > 0.02; step *= 0.5)
          for (int direction = 0; direction < 8; ++direction) {
            const Vertex kept = P;
            const double angle = direction * std::numbers::pi / 4;
            const Factor f(kept.metric());
            const double dy = step * std::sin(angle) / f.r, dx = (step * std::cos(angle) - f.q * dy) / f.p;
            P.x += dx, P.y += dy;
            const double now = worst_around(v);
            if (now > best + 1e-4) {
              best = now;
              const Metric2 m = space_.at(P.point());
              P.a = static_cast<float>(m.a), P.b = static_cast<float>(m.b), P.c = static_cast<float>(m.c);
              any = true;
            } else {
              P = kept;
            }
          }
      }
    }
    if (!any) break;
  }
}

}  // namespace carreau::plane
