// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/edits/judgement.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "metric/unit_edge.h"
#include "surface/remesh/base/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::remesh;

using Place = CrossPatchMesh::Place;
using Quad = CrossPatchMesh::Quad;

int is_out_of_range(const CrossPatchMesh& mesh, std::int32_t v, std::int32_t w) {
  const double l = mesh.length(v, w);
  return l < unit_edge::shortest || l > unit_edge::longest ? 1 : 0;
}

// Returns whether the collapse makes, or has, a triangle with all corners on sharp lines.
bool spans_lines(const CrossPatchMesh& mesh, std::int32_t gone, std::int32_t kept) {
  return std::ranges::any_of(mesh.mesh().fan(gone), [&](Place p) {
    const auto& t = mesh.mesh().at(p);
    const bool on_lines = std::ranges::none_of(t, [&](std::int32_t w) { return w != gone && mesh.is_free(w); });
    return on_lines && (mesh.is_free(gone) || (!mesh.is_free(kept) && !has_corner(t, kept)));
  });
}

}  // namespace

void judge_pair(const CrossPatchMesh& mesh, const Quad& q, Judge judge, TriangleShapes& shapes) {
  (mesh.*judge)(q.a, q.b, q.c, shapes), (mesh.*judge)(q.b, q.a, q.d, shapes);
}

void judge_swap(const CrossPatchMesh& mesh, const Quad& q, Judge judge, Change& change) {
  judge_pair(mesh, q, judge, change.before);
  for (const auto& [a, b, c] : EditableMesh::swapped(q)) (mesh.*judge)(a, b, c, change.after);
}

Change judge_split(const CrossPatchMesh& mesh, const Quad& q, std::int32_t m) {
  Change change;
  judge_pair(mesh, q, &CrossPatchMesh::judge, change.before);
  for (const auto& [a, b, c] : split_parts(q, m)) mesh.judge(a, b, c, change.after);
  return change;
}

void judge_collapse(const CrossPatchMesh& mesh, std::int32_t gone, std::int32_t kept, Judge judge, Change& change) {
  for (const Place p : mesh.mesh().fan(gone)) {
    const auto& t = mesh.mesh().at(p);
    if (has_corner(t, kept)) continue;
    (mesh.*judge)(t[0], t[1], t[2], change.before);
    const int i = mesh.mesh().rank_in(p, gone);
    (mesh.*judge)(kept, t[(i + 1) % 3], t[(i + 2) % 3], change.after);
  }
}

std::optional<SurfacePlace> middle_of(CrossPatchMesh& mesh, const Quad& q) {
  const Vec3 middle = 0.5 * (mesh.position(q.a) + mesh.position(q.b)), normal = mesh.mesh().mean_normal(q.places());
  auto found = mesh.near(q.a, normal, middle);
  return found ? found : mesh.near(q.b, normal, middle);
}

Vec3 beside(const SurfacePlace& from, double distance, int k, int directions) {
  const Vec3 least = std::abs(from.normal[0]) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 across = cross(from.normal, least), p = (1 / norm(across)) * across, q = cross(from.normal, p);
  const double angle = 2 * std::numbers::pi * k / directions;
  return from.xyz + distance * (std::cos(angle) * p + std::sin(angle) * q);
}

int out_of_range(const CrossPatchMesh& mesh, std::int32_t v) {
  int out = 0;
  if (mesh.is_free(v))  // each neighbour begins one side
    for (const Place p : mesh.mesh().fan(v)) out += is_out_of_range(mesh, v, mesh.mesh().at(p)[(mesh.mesh().rank_in(p, v) + 1) % 3]);
  else
    for (const std::int32_t w : mesh.mesh().ring(v)) out += is_out_of_range(mesh, v, w);
  return out;
}

std::optional<double> cost_of_collapse(const CrossPatchMesh& mesh, std::int32_t gone, std::int32_t kept, const Change& change) {
  const ShapeBudget& budget = mesh.budget;
  if (!(budget.price < infinity) || (!budget.is_limited() && !spans_lines(mesh, gone, kept))) return 0;
  TriangleShapes all = change.before;
  std::vector<std::int32_t> both;  // neighbours of the two ends
  for (const Place p : mesh.mesh().fan(gone)) {
    const auto& t = mesh.mesh().at(p);
    if (!has_corner(t, kept)) continue;
    mesh.judge_shape(t[0], t[1], t[2], all);
    for (const std::int32_t w : t)
      if (w != gone && w != kept) both.push_back(w);
  }
  int gain = 0;
  for (const std::int32_t w : mesh.mesh().ring(gone)) {
    gain += is_out_of_range(mesh, gone, w);
    if (w != kept && std::ranges::find(both, w) == both.end()) gain -= is_out_of_range(mesh, kept, w);
  }
  const double cost = budget.cost(all, change.after);
  if (cost > budget.price * gain || !budget.affords(cost)) return {};
  return cost;
}

}  // namespace carreau
