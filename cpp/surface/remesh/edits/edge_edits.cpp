// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/edits/edge_edits.h"

#include <algorithm>

#include "metric/metric2.h"
#include "metric/unit_edge.h"
#include "surface/remesh/base/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::remesh;

using Place = CrossPatchMesh::Place;
using Quad = CrossPatchMesh::Quad;

/// HDR eq. 4.84.
double edge_quality(double length) noexcept { return length <= 1 ? length : 1 / length; }

}  // namespace

bool evens_degrees(const CrossPatchMesh& mesh, std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
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

bool swap_edge(CrossPatchMesh& mesh, const Quad& q, bool for_degrees) {
  if (const double l = mesh.length(q.c, q.d); l > unit_edge::longest && l > mesh.length(q.a, q.b)) return false;
  Change change;
  judge_swap(mesh, q, &CrossPatchMesh::judge_shape, change);
  const auto& [before, after] = change;
  const bool better = after.worst >= before.worst + min_gain ||
                      (for_degrees && after.worst >= std::max(min_shape_of_degrees, mesh.budget.floor));
  const double cost = mesh.budget.cost(before, after);
  if (!better || !mesh.budget.affords(cost)) return false;
  judge_swap(mesh, q, &CrossPatchMesh::judge_agreement, change);
  if (!change.keeps_surface() || !mesh.swap(q)) return false;
  mesh.budget.pay(cost);
  return true;
}

namespace {

// `whatever_length`: lengths need not gain.
std::optional<std::int32_t> split(CrossPatchMesh& mesh, const Quad& q, bool whatever_length) {
  const auto at = middle_of(mesh, q);
  if (!at) return {};
  const double was = edge_quality(mesh.length(q.a, q.b));
  const std::int32_t m = mesh.try_vertex(*at);
  double least = 1;
  for (const std::int32_t v : {q.a, q.b, q.c, q.d}) least = std::min(least, edge_quality(mesh.length(m, v)));
  const Change change = judge_split(mesh, q, m);
  mesh.forget_vertex();
  const bool gains = whatever_length || least > was;
  const double floor = whatever_length ? flat_shape : std::max(min_shape, mesh.budget.floor);
  if (!gains || !change.keeps_surface() || !change.keeps_shapes(floor)) return {};
  const double cost = mesh.budget.cost(change.before, change.after);
  if (!mesh.budget.affords(cost)) return {};
  mesh.budget.pay(cost);
  return mesh.split(q, *at);
}

}  // namespace

std::optional<std::int32_t> split_edge(CrossPatchMesh& mesh, const Quad& q) { return split(mesh, q, false); }

std::optional<std::int32_t> halve_edge(CrossPatchMesh& mesh, const Quad& q) { return split(mesh, q, true); }

CollapseShapes shapes_after_collapse(const CrossPatchMesh& mesh, std::int32_t gone, std::int32_t kept, bool dense) {
  if (dense && !mesh.is_free(gone)) return {};
  const double short_one = mesh.length(gone, kept);
  bool adjacent = false;
  for (const Place p : mesh.mesh().fan(gone)) {
    const auto& t = mesh.mesh().at(p);
    if (has_corner(t, kept)) {
      adjacent = true;
      continue;
    }
    for (const std::int32_t w : t) {
      if (w == gone) continue;
      const double l = mesh.length(kept, w);
      if (l > never_longer || (!dense && l > unit_edge::longest && 1 / l < short_one)) return {};
    }
  }
  if (!adjacent) return {};
  Change change;
  judge_collapse(mesh, gone, kept, &CrossPatchMesh::judge_shape, change);
  const double floor = std::max(dense ? min_shape_when_dense : min_shape, mesh.budget.floor);
  if (dense ? change.after.worst < floor : !change.keeps_shapes(floor)) return {};
  const auto cost = cost_of_collapse(mesh, gone, kept, change);
  return cost ? CollapseShapes{change.after.worst, *cost} : CollapseShapes{};
}

bool is_dense(const CrossPatchMesh& mesh, std::int32_t v, std::int32_t w) {
  double area = 0;
  int count = -2;
  for (const std::int32_t end : {v, w})
    for (const Place p : mesh.mesh().fan(end)) {
      const auto& t = mesh.mesh().at(p);
      if (end == w && has_corner(t, v)) continue;
      area += mesh.double_area(t) / 2;
      ++count;
    }
  return area <= 0.5 * half_root3 * count * max_mean_area;
}

bool collapse_edge(CrossPatchMesh& mesh, std::int32_t gone, std::int32_t kept) {
  Change change;
  judge_collapse(mesh, gone, kept, &CrossPatchMesh::judge_agreement, change);
  return change.keeps_surface() && mesh.collapse(gone, kept);
}

}  // namespace carreau
