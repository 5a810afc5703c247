// Moves of all vertices at once.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane/optimiser.h"
#include "predicates/predicates.h"

namespace carreau::plane {

namespace {

constexpr double least_area = 0.2;  // of a parallelogram in the metric after a move (ideal: 0.87)
constexpr int undo_rounds = 20;
constexpr int triangles_between_checks = 1 << 16;
constexpr std::size_t prefetch_distance = 12;

}  // namespace

void Optimiser::propose_in_chart(const Triangle& T, double weight) {
  const ChartedTriangle triangle = shapes_.charted(T);
  const Vec2 y[3] = {triangle.a, triangle.b, triangle.c};
  for (int i = 0; i < 3; ++i) {
    const Vec2 from = y[next3[i]], to = y[prev3[i]], e = to - from;
    const Vec2 top =
        triangle.chart.point(0.5 * (from + to) + 0.5 * std::numbers::sqrt3 * Vec2{-e.y, e.x}, mesh_.at(T.v[i]));
    Proposal& p = proposals_[T.v[i]];
    p.x += weight * top.x, p.y += weight * top.y;
    p.weight += weight;
  }
}

// Each triangle proposes to each of its vertices the place where it would be equilateral in its metric, or, as far as
// that is the aim, where its sides would have unit length: lower over long bases, higher over short ones. Where sizes
// vary triangles count by the inverse of the size. That of its square would make the sum of their defects, each
// relative to the triangle, least; but where sizes jump it draws vertices to the small ones.
void Optimiser::propose(Aim aim) {
  proposals_.assign(mesh_.vertices.size(), {});
  const double slope = 2.0 / 3 * aim.pull;
  const std::size_t n = mesh_.triangles.size();
  for (std::size_t t = 0; t < n; ++t) {
    const Triangle& T = mesh_.triangles[t];
    if (t + prefetch_distance < n)
      for (const std::int32_t v : mesh_.triangles[t + prefetch_distance].v) {
        prefetch(&mesh_.vertices[v]);
        prefetch(&proposals_[v]);
      }
    const Vertex &P = mesh_.vertices[T.v[0]], &Q = mesh_.vertices[T.v[1]], &R = mesh_.vertices[T.v[2]];
    const Metric2 m = P.metric() + Q.metric() + R.metric();
    const double root = std::sqrt(std::max(determinant(m), 1e-300)), weight = aim.by_size ? std::sqrt(root) : 1;
    if (shapes_.is_bent(T)) {
      propose_in_chart(T, weight);
      continue;
    }
    const double k = 0.5 * std::numbers::sqrt3 / root;
    const auto tell = [&](int v, const Vertex& from, const Vertex& to) {
      const double ex = to.x - from.x, ey = to.y - from.y, nx = m.b * ex + m.c * ey, ny = m.a * ex + m.b * ey;
      // The height of a unit isosceles triangle over that of an equilateral one, to first order in the squared base.
      const double height = k * (1 + slope - slope * std::clamp((ex * ny + ey * nx) / 3, 0.5, 2.0));
      Proposal& p = proposals_[v];
      p.x += weight * (0.5 * (from.x + to.x) - height * nx);
      p.y += weight * (0.5 * (from.y + to.y) + height * ny);
      p.weight += weight;
    };
    tell(T.v[0], Q, R);
    tell(T.v[1], R, P);
    tell(T.v[2], P, Q);
  }
}

bool Optimiser::sound(const Triangle& T) const {
  const Vertex &A = mesh_.vertices[T.v[0]], &B = mesh_.vertices[T.v[1]], &C = mesh_.vertices[T.v[2]];
  if (shapes_.is_bent(T))
    return orientation(A.point(), B.point(), C.point()) > 0 &&
           shapes_.lengths(T.v[0], T.v[1], T.v[2]).area2() > 4 * least_area * least_area;
  const Metric2 m = A.metric() + B.metric() + C.metric();
  const double area = cross(B.point() - A.point(), C.point() - A.point());
  return area > 0 && area * area * determinant(m) > 9 * least_area * least_area &&
         orientation(A.point(), B.point(), C.point()) > 0;
}

void Optimiser::undo_spoiling_moves() {
  const auto undo = [&](int v) {
    Vertex& P = mesh_.vertices[v];
    if (P.x == proposals_[v].x && P.y == proposals_[v].y) return false;
    P.x = proposals_[v].x, P.y = proposals_[v].y;
    return true;
  };
  for (int round = 0; round < undo_rounds; ++round) {
    bool any = false;
    const std::size_t n = mesh_.triangles.size();
    for (std::size_t t = 0; t < n; ++t) {
      const Triangle& T = mesh_.triangles[t];
      if (t + prefetch_distance < n)
        for (const std::int32_t v : mesh_.triangles[t + prefetch_distance].v) prefetch(&mesh_.vertices[v]);
      if (sound(T)) continue;
      for (const std::int32_t v : T.v) any = (v >= fixed_ && undo(v)) || any;
    }
    if (!any) return;
  }
  for (int v = fixed_; v < static_cast<int>(mesh_.vertices.size()); ++v) undo(v);
}

// Each vertex goes `relaxation` of the way to the mean of its proposals; moves that spoil a triangle are undone.
void Optimiser::sweep(double relaxation, Aim aim) {
  monitor_.checkpoint();
  propose(aim);
  const auto n = static_cast<int>(mesh_.vertices.size());
  for (int v = fixed_; v < n; ++v) {
    Vertex& P = mesh_.vertices[v];
    Proposal& to = proposals_[v];
    const Vec2 old = P.point();
    if (to.weight > 0) P.x += relaxation * (to.x / to.weight - P.x), P.y += relaxation * (to.y / to.weight - P.y);
    to.x = old.x, to.y = old.y;
  }
  monitor_.checkpoint();
  undo_spoiling_moves();
}

// The metric follows the vertices at the end only: its change along a move is small.
void Optimiser::sweep_all(std::span<const double> relaxations, Aim aim) {
  for (const double relaxation : relaxations) sweep(relaxation, aim);
  update_metrics();
}

void Optimiser::update_metrics() {
  for (int v = fixed_; v < static_cast<int>(mesh_.vertices.size()); ++v) {
    if (v % triangles_between_checks == 0) monitor_.checkpoint();
    shapes_.set_metric(v);
  }
}

}  // namespace carreau::plane
