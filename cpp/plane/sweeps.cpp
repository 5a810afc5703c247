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

}  // namespace

// Each triangle proposes to each of its vertices the place where it would be equilateral in its metric.
void Optimiser::propose() {
  proposals_.assign(mesh_.vertices.size(), {});
  for (const Triangle& T : mesh_.triangles) {
    const Vertex &P = mesh_.vertices[T.v[0]], &Q = mesh_.vertices[T.v[1]], &R = mesh_.vertices[T.v[2]];
    const Metric2 m = P.metric() + Q.metric() + R.metric();
    const double k = 0.5 * std::numbers::sqrt3 / std::sqrt(std::max(determinant(m), 1e-300));
    const auto tell = [&](int v, const Vertex& from, const Vertex& to) {
      const double ex = to.x - from.x, ey = to.y - from.y;
      Proposal& p = proposals_[v];
      p.x += 0.5 * (from.x + to.x) - k * (m.b * ex + m.c * ey);
      p.y += 0.5 * (from.y + to.y) + k * (m.a * ex + m.b * ey);
      ++p.votes;
    };
    tell(T.v[0], Q, R);
    tell(T.v[1], R, P);
    tell(T.v[2], P, Q);
  }
}

bool Optimiser::sound(const Triangle& T) const {
  const Vertex &A = mesh_.vertices[T.v[0]], &B = mesh_.vertices[T.v[1]], &C = mesh_.vertices[T.v[2]];
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
    for (const Triangle& T : mesh_.triangles) {
      if (sound(T)) continue;
      for (const std::int32_t v : T.v) any = (v >= fixed_ && undo(v)) || any;
    }
    if (!any) return;
  }
  for (int v = fixed_; v < static_cast<int>(mesh_.vertices.size()); ++v) undo(v);
}

// Each vertex goes to the mean of its proposals; moves that spoil a triangle are undone.
void Optimiser::sweep() {
  monitor_.checkpoint();
  propose();
  const auto n = static_cast<int>(mesh_.vertices.size());
  for (int v = fixed_; v < n; ++v) {
    Vertex& P = mesh_.vertices[v];
    Proposal& to = proposals_[v];
    const Vec2 old = P.point();
    if (to.votes > 0) P.x = to.x / to.votes, P.y = to.y / to.votes;
    to.x = old.x, to.y = old.y;
  }
  monitor_.checkpoint();
  undo_spoiling_moves();
  for (int v = fixed_; v < n; ++v) {
    Vertex& P = mesh_.vertices[v];
    if (P.x != proposals_[v].x || P.y != proposals_[v].y) P.set_metric(field_.at(P.point()));
  }
}

}  // namespace carreau::plane
