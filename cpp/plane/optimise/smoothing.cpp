// Moves of all vertices at once.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane/optimise/optimiser.h"
#include "predicates/predicates.h"

namespace carreau::plane {

namespace {

constexpr double least_area = 0.2;  // of a parallelogram in the metric after a move (ideal: 0.87)
constexpr int undo_rounds = 20;
constexpr int triangles_between_checks = 1 << 16;
constexpr std::size_t prefetch_distance = 12;
// Bounds of what is kept of metrics: of the root of the determinant over the trace, and of that root.
constexpr double most_stretched = 1e-15, least_root = 1e-30;

// The same in the plane, times the root of the determinant of the sum of three metrics.
constexpr double least_area_in_sum = 3 * least_area;

// Of the triangle of three vertices. `enough(area)`: whether that is enough of it in the metric.
template <typename Enough>
inline bool has_area(const Vertex& A, const Vertex& B, const Vertex& C, const Enough& enough) noexcept {
  // The order of orientation(): its sign is decided by the same bound.
  const double left = (A.x - C.x) * (B.y - C.y), right = (A.y - C.y) * (B.x - C.x), area = left - right;
  if (!(area > 0 && enough(area))) return false;
  return area > detail::orientation_bound * (std::abs(left) + std::abs(right)) + detail::underflow_bound ||
         orientation(A.point(), B.point(), C.point()) > 0;
}

inline Metric2 sum_of_metrics(const Vertex& A, const Vertex& B, const Vertex& C) noexcept {
  return A.metric() + B.metric() + C.metric();
}

// Height of an equilateral triangle over the image of its base under a tensor turned by a quarter.
inline double equilateral_height(double root_of_determinant) noexcept {
  return 0.5 * std::numbers::sqrt3 / root_of_determinant;
}
inline double root_of_determinant(Metric2 m) noexcept { return std::sqrt(std::max(determinant(m), 1e-300)); }
inline double squared_weight(float weight) noexcept { return static_cast<double>(weight) * weight; }

}  // namespace

void Optimiser::propose_in_chart(const Triangle& T, double weight) {
  const ChartedTriangle triangle = shapes_.charted(T);
  const Vec2 y[3] = {triangle.a, triangle.b, triangle.c};
  for (int i = 0; i < 3; ++i) {
    const Vec2 from = y[next3[i]], to = y[prev3[i]], e = to - from;
    const Vec2 top =
        triangle.chart.point(0.5 * (from + to) + 0.5 * std::numbers::sqrt3 * Vec2{-e.y(), e.x()}, mesh_.at(T.v[i]));
    Vec2& p = proposals_[T.v[i]];
    p.x() += weight * top.x(), p.y() += weight * top.y();
  }
}

template <bool bends>
inline bool Optimiser::sound(std::size_t t) const {
  const Triangle& T = mesh_.triangles[t];
  const Vertex &A = mesh_.vertices[T.v[0]], &B = mesh_.vertices[T.v[1]], &C = mesh_.vertices[T.v[2]];
  if constexpr (bends)
    if (shapes_.is_bent(T))
      return orientation(A.point(), B.point(), C.point()) > 0 &&
             shapes_.lengths(T.v[0], T.v[1], T.v[2]).area2() > 4 * least_area * least_area;
  if (!steady_.empty()) {
    const double root = squared_weight(steady_[t].weight);
    return has_area(A, B, C, [root](double area) { return area * root > least_area_in_sum; });
  }
  const double det = determinant(sum_of_metrics(A, B, C));
  return has_area(A, B, C, [det](double area) { return area * area * det > 9 * least_area * least_area; });
}

// What sweeps need of the metrics, which stay as they are until the last of them. Where sizes vary triangles count by
// the inverse of the size. That of its square would make the sum of their defects, each relative to the triangle,
// least; but where sizes jump it draws vertices to the small ones.
void Optimiser::prepare(bool by_size) {
  steady_.clear();
  if (by_size) steady_.reserve(mesh_.triangles.size());
  weights_.assign(mesh_.vertices.size(), 0);
  for (const Triangle& T : mesh_.triangles) {
    double weight = 1;
    if (by_size) {
      const Metric2 m = sum_of_metrics(mesh_.vertices[T.v[0]], mesh_.vertices[T.v[1]], mesh_.vertices[T.v[2]]);
      // Of numbers that fit into single precision, whatever the metric.
      const double root = std::max({root_of_determinant(m), most_stretched * (m.a + m.c), least_root});
      const double height = equilateral_height(root);
      const auto single = static_cast<float>(std::sqrt(root));
      weight = single;
      steady_.push_back({static_cast<float>(height * m.a), static_cast<float>(height * m.b),
                         static_cast<float>(height * m.c), single});
    }
    for (const std::int32_t v : T.v) weights_[v] += weight;
  }
}

// Each triangle proposes to each of its vertices the place where it would be equilateral in its metric, or, as far as
// that is the aim, where its sides would have unit length: lower over long bases, higher over short ones.
// Lists the triangles that the moves before have spoiled, since all is at hand: they still tell where they would go.
template <bool by_size, bool bends>
void Optimiser::propose(double pull) {
  proposals_.assign(mesh_.vertices.size(), {});
  spoiled_.clear();
  // The height of a unit isosceles triangle over that of an equilateral one is, to first order in the squared base,
  // 1 + slope - slope * base.
  const double slope = 2.0 / 3 * pull, third = slope / 3;
  const std::size_t n = mesh_.triangles.size();
  // Plain addresses: what is written might be their vectors', for all that a compiler can tell.
  const Triangle* const triangles = mesh_.triangles.data();
  const Vertex* const vertices = mesh_.vertices.data();
  const Steady* const steady = steady_.data();
  Vec2* const proposals = proposals_.data();
  for (std::size_t t = 0; t < n; ++t) {
    const Triangle& T = triangles[t];
    for (const std::int32_t v : triangles[std::min(t + prefetch_distance, n - 1)].v) {
      prefetch(vertices + v);
      prefetch(proposals + v);
    }
    if constexpr (bends)
      if (shapes_.is_bent(T)) {
        if (!sound<true>(t)) spoiled_.push_back(static_cast<std::int32_t>(t));
        propose_in_chart(T, by_size ? steady[t].weight : 1);
        continue;
      }
    const Vertex &P = vertices[T.v[0]], &Q = vertices[T.v[1]], &R = vertices[T.v[2]];
    Metric2 m;
    double k0, k1, low, high, weight = 1;  // of heights over normals by m
    bool spoiled;
    if constexpr (by_size) {
      const Steady& S = steady[t];
      m = {S.a, S.b, S.c}, weight = S.weight;
      const double root = weight * weight;
      spoiled = !has_area(P, Q, R, [root](double area) { return area * root > least_area_in_sum; });
      k0 = 1 + slope, k1 = third / equilateral_height(1) * root, low = 1.5 * third, high = 6 * third;
    } else {
      m = sum_of_metrics(P, Q, R);
      const double det = determinant(m), k = equilateral_height(root_of_determinant(m));
      spoiled = !has_area(P, Q, R, [det](double area) { return area * area * det > 9 * least_area * least_area; });
      k0 = k * (1 + slope), k1 = k * third, low = 1.5 * k1, high = 6 * k1;
    }
    if (spoiled) spoiled_.push_back(static_cast<std::int32_t>(t));
    const auto tell = [&](int v, const Vertex& from, const Vertex& to) {
      // The metric's normal of the base, to the left.
      const double ex = to.x - from.x, ey = to.y - from.y, nx = -m.b * ex + -m.c * ey, ny = m.a * ex + m.b * ey;
      const double height = k0 - std::min(std::max(k1 * (ex * ny - ey * nx), low), high);
      const double x = 0.5 * (from.x + to.x) + height * nx, y = 0.5 * (from.y + to.y) + height * ny;
      Vec2& p = proposals[v];
      p.x() += by_size ? weight * x : x;
      p.y() += by_size ? weight * y : y;
    };
    tell(T.v[0], Q, R);
    tell(T.v[1], R, P);
    tell(T.v[2], P, Q);
  }
}

bool Optimiser::undo(int v) {
  Vertex& P = mesh_.vertices[v];
  if (v < fixed_ || P.point() == before_[v]) return false;
  P.x = before_[v].x(), P.y = before_[v].y();
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
    if (!sound<bends>(t)) spoiled_.push_back(static_cast<std::int32_t>(t));
  }
}

// The vertices of the triangles listed go back, then those of triangles around them that are spoiled by that.
template <bool bends>
void Optimiser::undo_spoiling_moves() {
  for (int round = 0; round < undo_rounds; ++round) {
    undone_.clear();
    for (const std::int32_t t : spoiled_)
      if (!sound<bends>(static_cast<std::size_t>(t)))
        for (const std::int32_t v : mesh_.triangles[t].v) undo(v);
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
    const Vec2 to = proposals_[v], old = P.point();
    if (weights_[v] > 0) {
      const double share = relaxation / weights_[v], kept = momentum - relaxation;
      P.x += share * to.x() + kept * P.x - momentum * before_[v].x();
      P.y += share * to.y() + kept * P.y - momentum * before_[v].y();
    }
    before_[v] = old;
  }
}

// Moves that spoil a triangle are taken back when the next sweep has seen that, or after the last one.
void Optimiser::sweep_all(std::span<const Sweep> sweeps, Aim aim) {
  before_.resize(mesh_.vertices.size());
  prepare(aim.by_size);
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

// The metric follows the vertices afterwards: its change along a move is small.
void Optimiser::sweep_all(std::span<const double> relaxations, Aim aim) {
  std::vector<Sweep> sweeps;
  for (const double relaxation : relaxations) sweeps.push_back({relaxation, 0});
  sweep_all(sweeps, aim);
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
