// SPDX-License-Identifier: BSD-3-Clause
#include "surface/independent/edits/edge_edits.h"

#include <algorithm>
#include <utility>

#include "metric/metric2.h"
#include "surface/independent/base/thresholds.h"
#include "surface/independent/edits/collapse_price.h"

namespace carreau {

namespace {

using namespace thresholds::independent;

using Place = FreeMesh::Place;
using Quad = FreeMesh::Quad;

/// HDR eq. 4.84.
double edge_quality(double length) noexcept { return length <= 1 ? length : 1 / length; }

bool has(const EditableMesh::Triangle& t, std::int32_t v) noexcept { return t[0] == v || t[1] == v || t[2] == v; }

/// Judges the triangles around a vertex that goes. `judge` adds one, `refuses` rejects the collapse because of a new
/// edge's end.
template <typename Judge, typename Refuses>
bool judge_collapse(const FreeMesh& mesh, std::int32_t gone, std::int32_t kept, const Judge& judge, const Refuses& refuses,
                    TriangleShapes& before, TriangleShapes& after) {
  bool adjacent = false;
  for (const Place p : mesh.mesh().fan(gone)) {
    const auto& t = mesh.mesh().at(p);
    if (has(t, kept)) {
      adjacent = true;
      continue;
    }
    const int i = mesh.mesh().rank_in(p, gone);
    const std::int32_t j = t[(i + 1) % 3], k = t[(i + 2) % 3];
    if (refuses(j) || refuses(k)) return false;
    judge(t[0], t[1], t[2], before);
    judge(kept, j, k, after);
  }
  return adjacent;
}

}  // namespace

int out_of_range(const FreeMesh& mesh, std::int32_t v) {
  int out = 0;
  const auto look = [&](std::int32_t w) {
    const double l = mesh.length(v, w);
    out += l < shortest || l > longest ? 1 : 0;
  };
  if (mesh.is_free(v))  // each neighbour begins one side
    for (const Place p : mesh.mesh().fan(v)) look(mesh.mesh().at(p)[(mesh.mesh().rank_in(p, v) + 1) % 3]);
  else
    for (const std::int32_t w : mesh.mesh().ring(v)) look(w);
  return out;
}

bool evens_degrees(const FreeMesh& mesh, std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
  if (!mesh.is_free(a) || !mesh.is_free(b)) return false;
  const auto excess = [&](std::int32_t v) {
    return mesh.is_free(v) ? static_cast<int>(mesh.mesh().fan(v).size()) - 6 : 0;
  };
  // The effect of moving one edge from a and b to c and d.
  int gain = 0;
  for (const std::int32_t v : {a, b}) gain += 2 * excess(v) - 1;
  for (const std::int32_t v : {c, d}) gain -= mesh.is_free(v) ? 2 * excess(v) + 1 : 1;
  return gain > 0;
}

bool is_too_long(const FreeMesh& mesh, std::int32_t v, std::int32_t w, std::int32_t c, std::int32_t d) {
  const double l = mesh.length(c, d);
  return l > longest && l > mesh.length(v, w);
}

bool swap_edge(FreeMesh& mesh, const Quad& q, bool for_degrees) {
  if (is_too_long(mesh, q.a, q.b, q.c, q.d)) return false;
  TriangleShapes before, after;
  mesh.judge_shape(q.a, q.b, q.c, before), mesh.judge_shape(q.b, q.a, q.d, before);
  mesh.judge_shape(q.a, q.d, q.c, after), mesh.judge_shape(q.d, q.b, q.c, after);
  const bool better = after.worst >= before.worst + least_gain ||
                      (for_degrees && after.worst >= std::max(least_shape_of_degrees, mesh.budget.floor));
  const double cost = mesh.budget.cost(before, after);
  if (!better || !mesh.budget.affords(cost)) return false;
  mesh.judge_agreement(q.a, q.b, q.c, before), mesh.judge_agreement(q.b, q.a, q.d, before);
  mesh.judge_agreement(q.a, q.d, q.c, after), mesh.judge_agreement(q.d, q.b, q.c, after);
  if (!FreeMesh::agrees(before, after) || !mesh.swap(q)) return false;
  mesh.budget.pay(cost);
  return true;
}

namespace {

// `whatever_length`: lengths need not gain.
std::optional<std::int32_t> split(FreeMesh& mesh, const Quad& q, bool whatever_length) {
  const Vec3 middle = 0.5 * (mesh.position(q.a) + mesh.position(q.b));
  const Vec3 normal = mesh.mesh().mean_normal(q.places());
  auto at = mesh.near(q.a, normal, middle);
  if (!at) at = mesh.near(q.b, normal, middle);
  if (!at) return {};
  TriangleShapes before, after;
  mesh.judge(q.a, q.b, q.c, before), mesh.judge(q.b, q.a, q.d, before);
  const double was = edge_quality(mesh.length(q.a, q.b));
  const std::int32_t m = mesh.try_vertex(*at);
  double least = 1;
  for (const std::int32_t v : {q.a, q.b, q.c, q.d}) least = std::min(least, edge_quality(mesh.length(m, v)));
  for (const auto& [v, w] : {std::pair{q.a, q.c}, std::pair{q.c, q.b}, std::pair{q.b, q.d}, std::pair{q.d, q.a}})
    mesh.judge(w, v, m, after);
  mesh.forget_vertex();
  const bool gains = whatever_length || least > was;
  const double floor = whatever_length ? flat_shape : std::max(least_shape, mesh.budget.floor);
  if (!gains || !FreeMesh::agrees(before, after) || after.worst < std::min(before.worst, floor)) return {};
  const double cost = mesh.budget.cost(before, after);
  if (!mesh.budget.affords(cost)) return {};
  mesh.budget.pay(cost);
  return mesh.split(q, *at);
}

}  // namespace

std::optional<std::int32_t> split_edge(FreeMesh& mesh, const Quad& q) { return split(mesh, q, false); }

std::optional<std::int32_t> halve_edge(FreeMesh& mesh, const Quad& q) { return split(mesh, q, true); }

CollapseShapes shapes_when_short(const FreeMesh& mesh, std::int32_t gone, std::int32_t kept) {
  const double short_one = mesh.length(gone, kept);
  TriangleShapes before, after;
  const auto is_worse = [&](std::int32_t w) {
    const double l = mesh.length(kept, w);
    return l > longest && (l > never_longer || 1 / l < short_one);
  };
  const auto judge = [&](auto a, auto b, auto c, TriangleShapes& s) { mesh.judge_shape(a, b, c, s); };
  if (!judge_collapse(mesh, gone, kept, judge, is_worse, before, after)) return {};
  if (after.worst < std::min(before.worst, std::max(least_shape, mesh.budget.floor))) return {};
  const auto cost = cost_of_collapse(mesh, gone, kept, before, after);
  return cost ? CollapseShapes{after.worst, *cost} : CollapseShapes{};
}

CollapseShapes shapes_when_dense(const FreeMesh& mesh, std::int32_t gone, std::int32_t kept) {
  if (!mesh.is_free(gone)) return {};
  TriangleShapes before, after;
  const auto is_worse = [&](std::int32_t w) { return mesh.length(kept, w) > never_longer; };
  const auto judge = [&](auto a, auto b, auto c, TriangleShapes& s) { mesh.judge_shape(a, b, c, s); };
  if (!judge_collapse(mesh, gone, kept, judge, is_worse, before, after)) return {};
  if (after.worst < std::max(least_shape_when_dense, mesh.budget.floor)) return {};
  const auto cost = cost_of_collapse(mesh, gone, kept, before, after);
  return cost ? CollapseShapes{after.worst, *cost} : CollapseShapes{};
}

bool is_dense(const FreeMesh& mesh, std::int32_t v, std::int32_t w) {
  double area = 0;
  int count = -2;
  for (const std::int32_t end : {v, w})
    for (const Place p : mesh.mesh().fan(end)) {
      const auto& t = mesh.mesh().at(p);
      if (end == w && has(t, v)) continue;
      area += mesh.double_area(t) / 2;
      ++count;
    }
  return area <= 0.5 * half_root3 * count * most_mean_area;
}

bool collapse_edge(FreeMesh& mesh, std::int32_t gone, std::int32_t kept) {
  TriangleShapes before, after;
  const auto judge = [&](auto a, auto b, auto c, TriangleShapes& s) { mesh.judge_agreement(a, b, c, s); };
  return judge_collapse(mesh, gone, kept, judge, [](std::int32_t) { return false; }, before, after) &&
         FreeMesh::agrees(before, after) && mesh.collapse(gone, kept);
}

}  // namespace carreau
