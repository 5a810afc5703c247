// SPDX-License-Identifier: BSD-3-Clause
#include "plane/optimise/smoothing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane/kernel/pair.h"
#include "plane/kernel/star.h"
#include "plane/kernel/thresholds.h"
#include "predicates/predicates.h"
#include "support/work_bounds.h"
#include "support/work_sizes.h"

namespace carreau::plane {

namespace {

constexpr std::size_t prefetch_distance = 12;
// The limit in the plane, times the root of the determinant of the sum of three metrics.
constexpr double min_area_in_sum = 3 * min_area;

// True if the triangle of three vertices has area. `enough(area)`: returns true if that is enough in the metric.
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

void propose_in_chart(const PlaneWork& work, std::vector<Vec2>& proposals, const Triangle& T, double weight) {
  const ChartedTriangle triangle = work.shapes.charted(T);
  const Vec2 y[3] = {triangle.a, triangle.b, triangle.c};
  for (int i = 0; i < 3; ++i) {
    const Vec2 from = y[next3[i]], to = y[prev3[i]], e = to - from;
    const Vec2 top =
        triangle.chart.point(0.5 * (from + to) + 0.5 * std::numbers::sqrt3 * Vec2{-e.y(), e.x()}, work.mesh.at(T.v[i]));
    Vec2& p = proposals[T.v[i]];
    p.x() += weight * top.x(), p.y() += weight * top.y();
  }
}

// `bends`, here and below: true if the field may bend, so that each triangle must be tested.
template <bool bends>
inline bool is_sound(const PlaneWork& work, const SmoothingArrays& arrays, std::size_t t) {
  const Triangle& T = work.mesh.triangles[t];
  const Vertex &A = work.mesh.vertices[T.v[0]], &B = work.mesh.vertices[T.v[1]], &C = work.mesh.vertices[T.v[2]];
  if constexpr (bends)
    if (work.shapes.is_bent(T))
      return orientation(A.point(), B.point(), C.point()) > 0 &&
             work.shapes.lengths(T.v[0], T.v[1], T.v[2]).area2() > 4 * min_area * min_area;
  if (!arrays.steady.empty()) {
    const double root = squared_weight(arrays.steady[t].weight);
    return has_area(A, B, C, [root](double area) { return area * root > min_area_in_sum; });
  }
  const double det = determinant(sum_of_metrics(A, B, C));
  return has_area(A, B, C, [det](double area) { return area * area * det > 9 * min_area * min_area; });
}

// Prepares the metrics for passes; they stay constant until the last pass. In varying sizes triangles are weighted by
// the inverse of the size. The inverse of its square would minimise the sum of their defects, each relative to the
// triangle, but at jumps of sizes it draws vertices to the small ones.
void prepare(const Triangulation& mesh, SmoothingArrays& arrays, bool by_size) {
  arrays.before.resize(mesh.vertices.size());
  arrays.steady.clear();
  arrays.heights.clear();
  if (by_size) arrays.steady.reserve(mesh.triangles.size());
  if (!by_size) arrays.heights.reserve(mesh.triangles.size());
  arrays.weights.assign(mesh.vertices.size(), 0);
  const std::size_t n = mesh.triangles.size();
  for (std::size_t t = 0; t < n; ++t) {
    const Triangle& T = mesh.triangles[t];
    for (const std::int32_t v : mesh.triangles[std::min(t + prefetch_distance, n - 1)].v) prefetch(&mesh.vertices[v]);
    double weight = 1;
    const Metric2 m = sum_of_metrics(mesh.vertices[T.v[0]], mesh.vertices[T.v[1]], mesh.vertices[T.v[2]]);
    if (!by_size) {
      arrays.heights.push_back(equilateral_height(root_of_determinant(m)));
    } else {
      // Numbers that fit into single precision, whatever the metric.
      // Bounds for metrics in single precision. [MeshPlane.WildMetricsStillGiveAValidMesh]
      const double root = std::max({root_of_determinant(m), 1e-15 * (m.a + m.c), 1e-30});
      const double height = equilateral_height(root);
      const auto single = static_cast<float>(std::sqrt(root));
      weight = single;
      arrays.steady.push_back({static_cast<float>(height * m.a), static_cast<float>(height * m.b),
                               static_cast<float>(height * m.c), single});
    }
    for (const std::int32_t v : T.v) arrays.weights[v] += weight;
  }
}

// Each triangle proposes to each of its vertices the place where it would be equilateral in its metric. The aim of unit
// lengths lowers this place over long bases and raises it over short ones. Also lists the triangles that the previous
// moves have spoiled, since all data are at hand: they still make proposals.
template <bool by_size, bool bends>
void propose(const PlaneWork& work, SmoothingArrays& arrays, double pull) {
  const Triangulation& mesh = work.mesh;
  std::vector<std::int32_t>& spoiled_triangles = arrays.spoiled;
  arrays.proposals.assign(mesh.vertices.size(), {});
  spoiled_triangles.clear();
  // The ratio of the height of a unit isosceles triangle to the height of an equilateral one is, to first order in the
  // squared base, 1 + slope - slope * base.
  const double slope = 2.0 / 3 * pull, third = slope / 3;
  const std::size_t n = mesh.triangles.size();
  // Plain addresses: for the compiler, data written could be a part of the vectors themselves.
  const Triangle* const triangles = mesh.triangles.data();
  const Vertex* const vertices = mesh.vertices.data();
  const SmoothingArrays::Steady* const steady = arrays.steady.data();
  const double* const heights = arrays.heights.data();
  Vec2* const proposals = arrays.proposals.data();
  for (std::size_t t = 0; t < n; ++t) {
    const Triangle& T = triangles[t];
    for (const std::int32_t v : triangles[std::min(t + prefetch_distance, n - 1)].v) prefetch(vertices + v);
    if constexpr (bends)
      if (work.shapes.is_bent(T)) {
        if (!is_sound<true>(work, arrays, t)) spoiled_triangles.push_back(static_cast<std::int32_t>(t));
        propose_in_chart(work, arrays.proposals, T, by_size ? steady[t].weight : 1);
        continue;
      }
    const Vertex &P = vertices[T.v[0]], &Q = vertices[T.v[1]], &R = vertices[T.v[2]];
    Metric2 m;
    double k0, k1, low, high, weight = 1;  // of heights over normals by m
    bool spoiled;
    if constexpr (by_size) {
      const SmoothingArrays::Steady& S = steady[t];
      m = {S.a, S.b, S.c}, weight = S.weight;
      const double root = weight * weight;
      spoiled = !has_area(P, Q, R, [root](double area) { return area * root > min_area_in_sum; });
      k0 = 1 + slope, k1 = third / equilateral_height(1) * root, low = 1.5 * third, high = 6 * third;
    } else {
      m = sum_of_metrics(P, Q, R);
      const double det = determinant(m), k = heights[t];
      spoiled = !has_area(P, Q, R, [det](double area) { return area * area * det > 9 * min_area * min_area; });
      k0 = k * (1 + slope), k1 = k * third, low = 1.5 * k1, high = 6 * k1;
    }
    if (spoiled) spoiled_triangles.push_back(static_cast<std::int32_t>(t));
    // The metric's normal of a base, to the left.
    const Pair of_x{-m.b, m.a}, of_y{-m.c, m.b};
    const auto tell = [&](int v, Pair from, Pair to) {
      const Pair e = to - from, normal = of_x * first_twice(e) + of_y * second_twice(e);
      const Pair products = e * exchanged(normal);
      const double height = k0 - std::min(std::max(k1 * (products[0] - products[1]), low), high);
      const Pair top = both(0.5) * (from + to) + both(height) * normal;
      add(by_size ? both(weight) * top : top, proposals[v]);
    };
    const Pair p = pair_of(P), q = pair_of(Q), r = pair_of(R);
    tell(T.v[0], q, r);
    tell(T.v[1], r, p);
    tell(T.v[2], p, q);
  }
}

void take_back(PlaneWork& work, SmoothingArrays& arrays, int v) {
  Vertex& P = work.mesh.vertices[v];
  if (v < work.fixed || P.point() == arrays.before[v]) return;
  P.x = arrays.before[v].x(), P.y = arrays.before[v].y();
  arrays.undone.push_back(v);
}

// Lists the triangles that the last moves have spoiled.
template <bool bends>
void find_spoiled(const PlaneWork& work, SmoothingArrays& arrays) {
  const Triangulation& mesh = work.mesh;
  arrays.spoiled.clear();
  const std::size_t n = mesh.triangles.size();
  for (std::size_t t = 0; t < n; ++t) {
    if (t + prefetch_distance < n)
      for (const std::int32_t v : mesh.triangles[t + prefetch_distance].v) prefetch(&mesh.vertices[v]);
    if (!is_sound<bends>(work, arrays, t)) arrays.spoiled.push_back(static_cast<std::int32_t>(t));
  }
}

// The vertices of the triangles listed return to their places, then the vertices of triangles around them that this
// spoils.
template <bool bends>
void undo_spoiling_moves(PlaneWork& work, SmoothingArrays& arrays) {
  std::vector<std::int32_t>& spoiled = arrays.spoiled;
  Star star;
  for (int round = 0; round < work_bounds::passes; ++round) {
    arrays.undone.clear();
    for (const std::int32_t t : spoiled)
      if (!is_sound<bends>(work, arrays, static_cast<std::size_t>(t)))
        for (const std::int32_t v : work.mesh.triangles[t].v) take_back(work, arrays, v);
    if (arrays.undone.empty()) return;
    spoiled.clear();
    for (const std::int32_t v : arrays.undone) {
      star.collect(work.mesh, v);
      spoiled.insert(spoiled.end(), star.triangles.begin(), star.triangles.end());
    }
    std::sort(spoiled.begin(), spoiled.end());
    spoiled.erase(std::unique(spoiled.begin(), spoiled.end()), spoiled.end());
  }
  for (int v = work.fixed; v < static_cast<int>(work.mesh.vertices.size()); ++v) take_back(work, arrays, v);
}

struct SmoothingPass {
  double share;     // of the way to the mean of the proposals
  double momentum;  // share of the last move
};

// Each vertex goes some of the way to the mean of its proposals, and some of its last move again.
void move_all(PlaneWork& work, SmoothingArrays& arrays, SmoothingPass pass) {
  const auto n = static_cast<int>(work.mesh.vertices.size());
  const auto [share, momentum] = pass;
  for (int v = work.fixed; v < n; ++v) {
    Vertex& P = work.mesh.vertices[v];
    const Vec2 to = arrays.proposals[v], old = P.point();
    if (arrays.weights[v] > 0) {
      const double each = share / arrays.weights[v], kept = momentum - share;
      P.x += each * to.x() + kept * P.x - momentum * arrays.before[v].x();
      P.y += each * to.y() + kept * P.y - momentum * arrays.before[v].y();
    }
    arrays.before[v] = old;
  }
}

// Moves that spoil a triangle are taken back when the next pass has seen that, or after the last one.
template <bool by_size, bool bends>
void run(PlaneWork& work, SmoothingArrays& arrays, std::span<const SmoothingPass> passes, double pull) {
  prepare(work.mesh, arrays, by_size);
  bool first = true;
  for (const SmoothingPass& pass : passes) {
    work.monitor.checkpoint();
    propose<by_size, bends>(work, arrays, pull);
    if (!first) undo_spoiling_moves<bends>(work, arrays);
    work.monitor.checkpoint();
    move_all(work, arrays, pass);
    first = false;
  }
  find_spoiled<bends>(work, arrays);
  undo_spoiling_moves<bends>(work, arrays);
}

void run(PlaneWork& work, SmoothingArrays& arrays, std::span<const SmoothingPass> passes, SmoothingAim aim) {
  const bool bends = !work.mesh.bends.empty();
  if (aim.by_size)
    bends ? run<true, true>(work, arrays, passes, aim.pull) : run<true, false>(work, arrays, passes, aim.pull);
  else
    bends ? run<false, true>(work, arrays, passes, aim.pull) : run<false, false>(work, arrays, passes, aim.pull);
}

}  // namespace

void smooth(PlaneWork& work, SmoothingArrays& arrays, std::span<const double> shares, SmoothingAim aim) {
  std::vector<SmoothingPass> passes;
  for (const double share : shares) passes.push_back({share, 0});
  run(work, arrays, passes, aim);
}

// In a lattice of equilateral triangles the mean of a vertex' proposals is the mean of its six neighbours: it returns
// shares of a wave's lack from 0, for the longest, to 1.5.
void smooth_evenly(PlaneWork& work, SmoothingArrays& arrays, EvenDamping damping, SmoothingAim aim) {
  constexpr double fastest = 1.5;
  const double middle = 0.5 * (fastest + damping.slowest), half = 0.5 * (fastest - damping.slowest);
  std::vector<SmoothingPass> passes = {{1 / middle, 0}};
  for (int k = 1; k < damping.passes; ++k) {
    const double last = passes.back().share, carried = (k == 1 ? 0.5 : 0.25) * half * half * last * last;
    const double share = 1 / (middle - carried / last);
    passes.push_back({share, share * carried / last});
  }
  run(work, arrays, passes, aim);
}

void update_metrics(PlaneWork& work) {
  for (int v = work.fixed; v < static_cast<int>(work.mesh.vertices.size()); ++v) {
    if (v % work_sizes::steps == 0) work.monitor.checkpoint();
    work.shapes.set_metric(v);
  }
}

}  // namespace carreau::plane
