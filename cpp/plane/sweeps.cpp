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

// Of the triangle of three vertices, det being the determinant of the sum of their metrics.
inline bool has_area(const Vertex& A, const Vertex& B, const Vertex& C, double det) noexcept {
  // The order of orientation(): its sign is decided by the same bound.
  const double left = (A.x - C.x) * (B.y - C.y), right = (A.y - C.y) * (B.x - C.x), area = left - right;
  if (!(area > 0 && area * area * det > 9 * least_area * least_area)) return false;
  return area > detail::orientation_bound * (std::abs(left) + std::abs(right)) + detail::underflow_bound ||
         orientation(A.point(), B.point(), C.point()) > 0;
}

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

template <bool bends>
inline bool Optimiser::sound(const Triangle& T) const {
  const Vertex &A = mesh_.vertices[T.v[0]], &B = mesh_.vertices[T.v[1]], &C = mesh_.vertices[T.v[2]];
  if constexpr (bends)
    if (shapes_.is_bent(T))
      return orientation(A.point(), B.point(), C.point()) > 0 &&
             shapes_.lengths(T.v[0], T.v[1], T.v[2]).area2() > 4 * least_area * least_area;
  return has_area(A, B, C, determinant(A.metric() + B.metric() + C.metric()));
}

// Each triangle proposes to each of its vertices the place where it would be equilateral in its metric, or, as far as
// that is the aim, where its sides would have unit length: lower over long bases, higher over short ones. Where sizes
// vary triangles count by the inverse of the size. That of its square would make the sum of their defects, each
// relative to the triangle, least; but where sizes jump it draws vertices to the small ones.
// Lists the triangles that the moves before have spoiled, since all is at hand: they still tell where they would go.
template <bool by_size, bool bends>
void Optimiser::propose(double pull) {
  proposals_.assign(mesh_.vertices.size(), {});
  spoiled_.clear();
  const double slope = 2.0 / 3 * pull, third = slope / 3;
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
    const double det = determinant(m);
    const double root = std::sqrt(std::max(det, 1e-300)), weight = by_size ? std::sqrt(root) : 1;
    if constexpr (bends)
      if (shapes_.is_bent(T)) {
        if (!sound<true>(T)) spoiled_.push_back(static_cast<std::int32_t>(t));
        propose_in_chart(T, weight);
        continue;
      }
    if (!has_area(P, Q, R, det)) spoiled_.push_back(static_cast<std::int32_t>(t));
    // The height of a unit isosceles triangle over that of an equilateral one is, to first order in the squared base,
    // 1 + slope - slope * base.
    const double k = 0.5 * std::numbers::sqrt3 / root, k0 = k * (1 + slope), k1 = k * third;
    const auto tell = [&](int v, const Vertex& from, const Vertex& to) {
      // The metric's normal of the base, to the left.
      const double ex = to.x - from.x, ey = to.y - from.y, nx = -m.b * ex + -m.c * ey, ny = m.a * ex + m.b * ey;
      const double height = k0 - k1 * std::min(std::max(ex * ny - ey * nx, 1.5), 6.0);
      const double x = 0.5 * (from.x + to.x) + height * nx, y = 0.5 * (from.y + to.y) + height * ny;
      Proposal& p = proposals_[v];
      p.x += by_size ? weight * x : x;
      p.y += by_size ? weight * y : y;
      p.weight += weight;
    };
    tell(T.v[0], Q, R);
    tell(T.v[1], R, P);
    tell(T.v[2], P, Q);
  }
}

bool Optimiser::undo(int v) {
  Vertex& P = mesh_.vertices[v];
  if (v < fixed_ || P.point() == before_[v]) return false;
  P.x = before_[v].x, P.y = before_[v].y;
  undone_.push_back(v);
  return true;
}

// Lists the triangles that the last moves have spoiled.
template <bool bends>
void Optimiser::find_spoiled() {
  spoiled_.clear();
  const std::size_t n = mesh_.triangles.size();
  for (std::size_t t = 0; t < n; ++t) {
    if (t + prefetch_distance < n)
      for (const std::int32_t v : mesh_.triangles[t + prefetch_distance].v) prefetch(&mesh_.vertices[v]);
    if (!sound<bends>(mesh_.triangles[t])) spoiled_.push_back(static_cast<std::int32_t>(t));
  }
}

// The vertices of the triangles listed go back, then those of triangles around them that are spoiled by that.
template <bool bends>
void Optimiser::undo_spoiling_moves() {
  for (int round = 0; round < undo_rounds; ++round) {
    undone_.clear();
    for (const std::int32_t t : spoiled_)
      if (const Triangle& T = mesh_.triangles[t]; !sound<bends>(T))
        for (const std::int32_t v : T.v) undo(v);
    if (undone_.empty()) return;
    spoiled_.clear();
    for (const std::int32_t v : undone_) {
      collect_star(v);
      spoiled_.insert(spoiled_.end(), star_.begin(), star_.end());
    }
    std::sort(spoiled_.begin(), spoiled_.end());
    spoiled_.erase(std::unique(spoiled_.begin(), spoiled_.end()), spoiled_.end());
  }
  for (int v = fixed_; v < static_cast<int>(mesh_.vertices.size()); ++v) undo(v);
}

// Each vertex goes some of the way to the mean of its proposals, and some of its last move again.
template <bool by_size, bool bends>
void Optimiser::sweep(Sweep how, double pull, bool first) {
  monitor_.checkpoint();
  propose<by_size, bends>(pull);
  if (!first) undo_spoiling_moves<bends>();
  monitor_.checkpoint();
  const auto n = static_cast<int>(mesh_.vertices.size());
  const auto [relaxation, momentum] = how;
  for (int v = fixed_; v < n; ++v) {
    Vertex& P = mesh_.vertices[v];
    const Proposal& to = proposals_[v];
    const Vec2 old = P.point();
    if (to.weight > 0) {
      const double share = relaxation / to.weight, kept = momentum - relaxation;
      P.x += share * to.x + kept * P.x - momentum * before_[v].x;
      P.y += share * to.y + kept * P.y - momentum * before_[v].y;
    }
    before_[v] = old;
  }
}

// Moves that spoil a triangle are taken back when the next sweep has seen that, or after the last one.
void Optimiser::sweep_all(std::span<const Sweep> sweeps, Aim aim) {
  before_.resize(mesh_.vertices.size());
  const bool bends = !mesh_.bends.empty();
  bool first = true;
  for (const Sweep& s : sweeps) {
    if (aim.by_size)
      bends ? sweep<true, true>(s, aim.pull, first) : sweep<true, false>(s, aim.pull, first);
    else
      bends ? sweep<false, true>(s, aim.pull, first) : sweep<false, false>(s, aim.pull, first);
    first = false;
  }
  bends ? find_spoiled<true>() : find_spoiled<false>();
  bends ? undo_spoiling_moves<true>() : undo_spoiling_moves<false>();
}

// The metric follows the vertices at the end only: its change along a move is small.
void Optimiser::sweep_all(std::span<const double> relaxations, Aim aim) {
  std::vector<Sweep> sweeps;
  for (const double relaxation : relaxations) sweeps.push_back({relaxation, 0});
  sweep_all(sweeps, aim);
  update_metrics();
}

// Chebyshev's iteration of second order. In a lattice of equilateral triangles the mean of a vertex' proposals is that
// of its six neighbours: of what a wave lacks it returns shares from 0, for the longest, to 1.5. Metrics stay
// as they are.
void Optimiser::relax(Relaxation waves, Aim aim) {
  constexpr double fastest = 1.5;
  const double middle = 0.5 * (fastest + waves.slowest), half = 0.5 * (fastest - waves.slowest);
  std::vector<Sweep> sweeps = {{1 / middle, 0}};
  for (int k = 1; k < waves.sweeps; ++k) {
    const double last = sweeps.back().relaxation, carried = (k == 1 ? 0.5 : 0.25) * half * half * last * last;
    const double relaxation = 1 / (middle - carried / last);
    sweeps.push_back({relaxation, relaxation * carried / last});
  }
  sweep_all(sweeps, aim);
}

void Optimiser::update_metrics() {
  for (int v = fixed_; v < static_cast<int>(mesh_.vertices.size()); ++v) {
    if (v % triangles_between_checks == 0) monitor_.checkpoint();
    shapes_.set_metric(v);
  }
}

}  // namespace carreau::plane
