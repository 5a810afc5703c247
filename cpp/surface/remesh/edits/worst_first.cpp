// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/edits/worst_first.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <vector>

#include "metric/unit_edge.h"
#include "support/infinity.h"
#include "support/stepped_tasks.h"
#include "surface/remesh/base/thresholds.h"
#include "surface/remesh/edits/edge_edits.h"

namespace carreau {

namespace {

using namespace thresholds::remesh;

using Corners = EditableMesh::Triangle;

// Repeats failed edits only if their surroundings have changed; if the budget is limited, always.
class WorstFirst {
 public:
  WorstFirst(CrossPatchMesh& mesh, double floor, Monitor& monitor)
      : mesh_(mesh), floor_(floor), monitor_(monitor), forgets_(mesh.budget.is_limited()), changed_(mesh.vertices(), 1), tried_(mesh.vertices(), 0) {}

  std::int64_t run() {
    for (int pass = 0; pass < max_worst_passes; ++pass) {
      const std::int64_t before = edits_, began = now_;
      for (const auto& [shape, t] : below_floor()) {
        monitor_.checkpoint();
        if (!mesh_.is_alive(t[0]) || !is_triangle(t) || shape_of(t) >= floor_) continue;
        for (int i = 0; i < 3 && is_triangle(t); ++i) swap(t[i], t[(i + 1) % 3]);
        for (int i = 0; i < 3; ++i)
          if (mesh_.is_free(t[i])) move(t[i]);
      }
      last_began_ = began;
      if (edits_ == before) break;
    }
    return edits_;
  }

 private:
  [[nodiscard]] double shape_of(const Corners& t) const {
    TriangleShapes shapes;
    mesh_.judge_shape(t[0], t[1], t[2], shapes);
    return shapes.worst;
  }

  // Returns the triangles where something has changed since the last pass began.
  [[nodiscard]] std::vector<std::pair<double, Corners>> below_floor() const {
    std::vector<std::pair<double, Corners>> found;
    for (const Corners& t : mesh_.triangles()) {
      if (t[0] < 0 || (!forgets_ && std::ranges::none_of(t, [&](std::int32_t v) { return changed_[v] > last_began_; }))) continue;
      if (const double shape = shape_of(t); shape < floor_) found.emplace_back(shape, t);
    }
    std::ranges::sort(found);
    return found;
  }

  [[nodiscard]] bool is_triangle(const Corners& t) const {
    return std::ranges::any_of(mesh_.mesh().fan(t[0]), [&](CrossPatchMesh::Place p) { return mesh_.mesh().at(p) == t; });
  }

  void has_changed(std::int32_t v) {
    changed_[v] = ++now_;
    for (const CrossPatchMesh::Place p : mesh_.mesh().fan(v))
      for (const std::int32_t w : mesh_.mesh().at(p)) changed_[w] = now_;
  }

  void swap(std::int32_t v, std::int32_t w) {
    const auto q = mesh_.mesh().quad_between({0, v}, w);
    if (!q || !swap_edge(mesh_, *q)) return;
    ++edits_;
    for (const std::int32_t k : {q->a, q->b, q->c, q->d}) has_changed(k);
  }

  // Searches uphill in the tangent plane, by steps that become shorter.
  void move(std::int32_t v) {
    if (!forgets_ && tried_[v] >= changed_[v]) return;
    bool moved = false;
    for (double step = unit_edge::first_step; step > unit_edge::last_step;)
      if (step_uphill(v, step))
        moved = true;
      else
        step /= 2;
    if (moved) has_changed(v);
    tried_[v] = moved ? 0 : now_;
  }

  bool step_uphill(std::int32_t v, double step) {
    const SurfacePlace from = mesh_.place(v);
    if (!from.regular) return false;
    const double h = mesh_.size(v);
    const TriangleShapes before = mesh_.judge_shapes_around(v);
    if (before.worst >= floor_) return false;
    const TriangleShapes agreed = mesh_.judge_agreement_around(v);
    const int out = out_of_range(mesh_, v);
    SurfacePlace best = from;
    double worst = before.worst + min_gain, cost = 0;
    for (int k = 0; k < worst_directions; ++k) {
      const auto to = mesh_.near(v, from.normal, beside(from, step * h, k, worst_directions));
      if (!to) continue;
      const Trial trial(mesh_);
      mesh_.put(v, *to, mesh_.wanted_at(*to));
      const TriangleShapes after = mesh_.judge_shapes_around(v);
      if (after.worst > worst && out_of_range(mesh_, v) <= out && mesh_.budget.affords(before.sum - after.sum) &&
          Change{agreed, mesh_.judge_agreement_around(v)}.keeps_surface())
        worst = after.worst, cost = before.sum - after.sum, best = *to;
    }
    if (worst <= before.worst + min_gain) return false;
    mesh_.put(v, best, mesh_.wanted_at(best));
    mesh_.budget.pay(cost);
    ++edits_;
    return true;
  }

  CrossPatchMesh& mesh_;
  double floor_;
  Monitor& monitor_;
  bool forgets_;
  std::int64_t edits_ = 0;
  std::int64_t now_ = 1, last_began_ = 0;
  std::vector<std::int64_t> changed_, tried_;  // by vertex: number of the last change around it, and of the last search without a good move
};

}  // namespace

ShapeSummary summarise_shapes(const CrossPatchMesh& mesh, int threads, Monitor& monitor) {
  constexpr std::size_t at_once = 4096;
  const auto& all = mesh.triangles();
  std::vector<double> shape(all.size());
  const auto judge = [&](std::size_t part, Monitor&) {
    for (std::size_t t = part * at_once; t < std::min(all.size(), (part + 1) * at_once); ++t) {
      TriangleShapes shapes;
      if (all[t][0] >= 0) mesh.judge_shape(all[t][0], all[t][1], all[t][2], shapes);
      shape[t] = shapes.sum;
    }
  };
  run_each((all.size() + at_once - 1) / at_once, false, threads, judge, monitor);
  ShapeSummary summary;
  double sum = 0;
  for (std::size_t t = 0; t < all.size(); ++t)
    if (all[t][0] >= 0) sum += shape[t], summary.worst = std::min(summary.worst, shape[t]), ++summary.count;
  summary.mean = sum / std::max(summary.count, 1);
  return summary;
}

std::int64_t raise_worst(CrossPatchMesh& mesh, double floor, Monitor& monitor) {
  return WorstFirst(mesh, floor, monitor).run();
}

}  // namespace carreau
