// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/edits/vertex_moves.h"

#include <algorithm>
#include <cmath>

#include "mesh/quality.h"
#include "metric/metric2.h"
#include "metric/unit_edge.h"
#include "surface/remesh/base/thresholds.h"
#include "surface/remesh/edits/judgement.h"

namespace carreau {

namespace {

using namespace thresholds::remesh;

using Place = CrossPatchMesh::Place;

bool gains(const Change& change, const ShapeBudget& budget) noexcept {
  return change.after.inverses < change.before.inverses - min_gain && change.keeps_shapes(std::max(good_enough, budget.floor)) &&
         budget.affords(change.before.sum - change.after.sum);
}

}  // namespace

void VertexMover::look_around(std::int32_t v) {
  sides_.clear();
  for (const Place p : mesh_.mesh().fan(v)) {
    const auto& t = mesh_.mesh().at(p);
    const int i = mesh_.mesh().rank_in(p, v);
    const std::int32_t j = t[(i + 1) % 3], k = t[(i + 2) % 3];
    const Vec3 a = mesh_.position(j), b = mesh_.position(k), side = b - a;
    sides_.push_back({a, b, dot(side, side), mesh_.size(j), mesh_.size(k)});
  }
}

// The mean of the places where each triangle around would be equilateral. The side of that triangle is the mean of its
// fixed side and the prescribed side.
Vec3 VertexMover::ideal_place(const Vec3& from) const {
  Vec3 sum{0, 0, 0};
  double count = 0;
  for (const Side& s : sides_) {
    const Vec3 side = s.b - s.a, up = from - s.a;
    const double along = dot(up, side) / s.squared;
    const Vec3 across = up - along * side;
    const double height = norm(across);
    if (!(s.squared > 0) || !(height > 0)) continue;
    const double wanted = 0.5 * (std::sqrt(s.squared) + 0.5 * (s.h_a + s.h_b));
    sum += 0.5 * (s.a + s.b) + (half_root3 * wanted / height) * across;
    count += 1;
  }
  return count > 0 ? Vec3(sum / count) : from;
}

// The mean place, measured in the mean metric of each triangle.
Vec3 VertexMover::ideal_place_by_direction(std::int32_t v) const {
  Vec3 sum{0, 0, 0};
  double count = 0;
  for (const Place p : mesh_.mesh().fan(v)) {
    const auto& t = mesh_.mesh().at(p);
    const int i = mesh_.mesh().rank_in(p, v);
    const std::int32_t j = t[(i + 1) % 3], k = t[(i + 2) % 3];
    const Vec3 a = mesh_.position(j), b = mesh_.position(k), side = b - a, up = mesh_.position(v) - a;
    const Metric2 g = (1. / 3) * (gram(mesh_.metric(v), side, up) + gram(mesh_.metric(j), side, up) +
                                  gram(mesh_.metric(k), side, up));
    const double height2 = g.c - g.b * g.b / g.a;
    if (!(g.a > 0) || !(height2 > 0)) continue;
    const Vec3 across = up - (g.b / g.a) * side;
    const double wanted = 0.5 * (std::sqrt(g.a) + 1);
    sum += 0.5 * (a + b) + (half_root3 * wanted / std::sqrt(height2)) * across;
    count += 1;
  }
  return count > 0 ? Vec3(sum / count) : mesh_.position(v);
}

// Shapes as in CrossPatchMesh::judge_shape, with v there; HDR eq. 1.6.
TriangleShapes VertexMover::shapes(const Vec3& at) const {
  TriangleShapes shapes;
  for (const Side& s : sides_) {
    const Vec3 p = s.a - at, q = s.b - at;
    const double squares = dot(p, p) + dot(q, q) + s.squared;
    shapes.add(squares > 0 ? 4 * half_root3 * norm(cross(p, q)) / squares : 0);
  }
  return shapes;
}

// Each neighbour begins one side.
int VertexMover::out_of_range(const Vec3& at, double h) const {
  int out = 0;
  for (const Side& s : sides_) {
    const double l = length_between_sizes(norm(s.a - at), h, s.h_a);
    out += l < unit_edge::shortest || l > unit_edge::longest ? 1 : 0;
  }
  return out;
}

bool VertexMover::put_if_agrees(std::int32_t v, const SurfacePlace& to, const WantedSize& there) {
  Trial trial(mesh_);
  mesh_.put(v, to, there);
  Change change{.before = {}, .after = mesh_.judge_agreement_around(v)};
  if (change.after.share > 1) {
    (void)trial.undo();
    change.before = mesh_.judge_agreement_around(v);
    if (!change.keeps_surface()) return false;
    mesh_.put(v, to, there);
  }
  trial.accept();
  return true;
}

bool VertexMover::try_place(std::int32_t v, const SurfacePlace& to, const TriangleShapes& before, int out) {
  const bool by_direction = mesh_.by_direction();
  Change change{before, {}};
  if (!by_direction && !gains(change = {before, shapes(to.xyz)}, mesh_.budget)) return false;
  const WantedSize there = mesh_.wanted_at(to);
  if (by_direction) {
    const Trial trial(mesh_);
    mesh_.put(v, to, there);
    change.after = mesh_.judge_shapes_around(v);
    if (!gains(change, mesh_.budget) || carreau::out_of_range(mesh_, v) > out) return false;
  } else if (out_of_range(to.xyz, there.h) > out) {
    return false;
  }
  if (!put_if_agrees(v, to, there)) return false;
  mesh_.budget.pay(before.sum - change.after.sum);
  return true;
}

bool VertexMover::move(std::int32_t v) {
  const bool by_direction = mesh_.by_direction();
  const Vec3 from = mesh_.position(v), normal = mesh_.place(v).normal;
  if (!by_direction) look_around(v);
  const Vec3 ideal = by_direction ? ideal_place_by_direction(v) : ideal_place(from), way = ideal - from;
  if (by_direction ? length(mesh_.metric(v), way) < least_ : norm(way) < least_ * mesh_.size(v)) return false;
  const TriangleShapes before = by_direction ? mesh_.judge_shapes_around(v) : shapes(from);
  const int out = by_direction ? carreau::out_of_range(mesh_, v) : out_of_range(from, mesh_.size(v));
  for (const double share : {1.0, 0.4}) {
    const Vec3 target = lerp(from, ideal, share);
    // A place without gain beside the surface is not worth an evaluation.
    if (!by_direction && !gains({before, shapes(target)}, mesh_.budget)) continue;
    const auto to = mesh_.near(v, normal, target);
    if (to && try_place(v, *to, before, out)) return true;
  }
  return false;
}

}  // namespace carreau
