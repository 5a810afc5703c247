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

void Optimiser::propose_in_chart(const Triangle& T) {
  const ChartedTriangle triangle = shapes_.charted(T);
  const Vec2 y[3] = {triangle.a, triangle.b, triangle.c};
  for (int i = 0; i < 3; ++i) {
    const Vec2 from = y[next3[i]], to = y[prev3[i]], e = to - from;
    const Vec2 top =
        triangle.chart.point(0.5 * (from + to) + 0.5 * std::numbers::sqrt3 * Vec2{-e.y, e.x}, mesh_.at(T.v[i]));
    Proposal& p = proposals_[T.v[i]];
    p.x += top.x, p.y += top.y;
    ++p.votes;
  }
}

// Each triangle proposes to each of its vertices the place where it would be equilateral in its metric.
void Optimiser::propose() {
  proposals_.assign(mesh_.vertices.size(), {});
  const std::size_t n = mesh_.triangles.size();
  for (std::size_t t = 0; t < n; ++t) {
    const Triangle& T = mesh_.triangles[t];
    if (t + prefetch_distance < n)
      for (const std::int32_t v : mesh_.triangles[t + prefetch_distance].v) {
        prefetch(&mesh_.vertices[v]);
        prefetch(&proposals_[v]);
      }
    const Vertex &P = mesh_.vertices[T.v[0]], &Q = mesh_.vertices[T.v[1]], &R = mesh_.vertices[T.v[2]];
    if (shapes_.is_bent(T)) {
      propose_in_chart(T);
      continue;
    }
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
void Optimiser::sweep(double relaxation) {
  monitor_.checkpoint();
  propose();
  const auto n = static_cast<int>(mesh_.vertices.size());
  for (int v = fixed_; v < n; ++v) {
    Vertex& P = mesh_.vertices[v];
    Proposal& to = proposals_[v];
    const Vec2 old = P.point();
    if (to.votes > 0) P.x += relaxation * (to.x / to.votes - P.x), P.y += relaxation * (to.y / to.votes - P.y);
    to.x = old.x, to.y = old.y;
  }
  monitor_.checkpoint();
  undo_spoiling_moves();
}

// Far moves first to spread strain, short ones last against what they leave behind: four sweeps do the work of six. The
// metric follows the vertices only twice: its change along a move is small.
void Optimiser::sweep_all() {
  constexpr double relaxations[] = {1.6, 1.6, 1, 0.7};
  int done = 0;
  for (const double relaxation : relaxations) {
    sweep(relaxation);
    if (++done % 2 == 0) update_metrics();
  }
}

void Optimiser::update_metrics() {
  for (int v = fixed_; v < static_cast<int>(mesh_.vertices.size()); ++v) {
    if (v % triangles_between_checks == 0) monitor_.checkpoint();
    shapes_.set_metric(v);
  }
}

}  // namespace carreau::plane
