// SPDX-License-Identifier: BSD-3-Clause
// Shared by all searches for better edges on an assembled mesh, for any criterion: budget, tested places, later sizes.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "mesh/editable_mesh.h"
#include "mesh/local_search.h"
#include "mesh/trial.h"
#include "size/size_rules.h"
#include "surface/result.h"

namespace carreau {

/// Edits around some vertices of an assembled mesh. Keeps references to its arguments.
class AssembledSearch {
 public:
  using Vertex = EditableMesh::Vertex;
  using Place = EditableMesh::Place;

  AssembledSearch(std::span<const std::int32_t> centres, const SizeRules& rules, Cad& cad, CompositeResult& result);

  [[nodiscard]] EditableMesh& mesh() noexcept { return mesh_; }
  [[nodiscard]] const EditableMesh& mesh() const noexcept { return mesh_; }
  /// The number of points of surfaces that may still be evaluated.
  [[nodiscard]] const Budget& budget() const noexcept { return budget_; }
  /// Returns whether the face has a control space. Faces between matched sides have none, and stay.
  [[nodiscard]] bool is_sampled(std::int32_t face) const { return result_.spaces[face].has_value(); }
  /// The metric of the face's control space.
  [[nodiscard]] Metric2 metric(std::int32_t face, const Vec2& uv) const { return result_.spaces[face]->at(uv); }
  /// Evaluates position and derivatives, as one evaluation of the budget.
  SurfaceJet ask(std::int32_t face, const Vec2& uv);
  /// Returns whether no triangle is turned much from `mean`, the mean normal of the replaced triangles.
  [[nodiscard]] bool agree(std::span<const Place> places, const Vec3& mean) const;

  /// Returns the vertex and its neighbours, where work may be left after a change, without vertices beyond the edits.
  [[nodiscard]] std::vector<std::int32_t> left_around(std::int32_t v) const;
  /// Swaps the diagonal of a quadrilateral if the swap improves on `before` and turns no triangle much; else nothing
  /// changes. `after`: the judgement by judge() of the swapped quadrilateral.
  template <typename Judge, typename Judgement>
  bool swap_if_better(const EditableMesh::Quad& quad, const Judgement& before, double good, const Judge& judge,
                      Judgement& after) {
    const Vec3 mean = mesh_.mean_normal(quad.places());
    Trial trial(mesh_);
    if (!mesh_.swap(quad)) return false;
    after = judge();
    if (!after.improves(before, good) || !agree(quad.places(), mean)) return false;
    trial.accept();
    return true;
  }

  /// Notes a vertex whose size must be evaluated again.
  void note_changed(Vertex v) { changed_.push_back(v); }
  /// Evaluates the sizes of the noted vertices: by `size_of` a metric at a point.
  void update_sizes(double (*size_of)(const SurfaceJet&, Metric2), Monitor& monitor);

  /// A possible place of a vertex, and the criterion's data there.
  template <typename Known>
  struct Found {
    Vec2 uv;
    Vec3 xyz;
    Known known;
  };
  /// Returns the best place of a vertex inside by `judge()`, and its judgement `best`; nothing if the vertex has the best
  /// place already. The criterion keeps data of vertices: known(), learn(), set_known(). `accepts(now, before)` selects
  /// places.
  template <typename Criterion, typename Judge, typename Accepts, typename Judgement>
  auto best_place(Criterion& criterion, Vertex v, const Judge& judge, const Accepts& accepts, Judgement& best) {
    const std::vector<Place>& fan = mesh_.fan(mesh_.global(v));
    const Vec2 home = mesh_.uv(v);
    const Vec3 mean = mesh_.mean_normal(fan);
    const auto known = criterion.known(mesh_, v);
    const Judgement before = judge();
    best = before;
    std::optional<Found<std::remove_const_t<decltype(known)>>> found;
    for_placements(UnitCircle(metric(v.face, home)), [&](const Vec2& offset) {
      const Vec2 uv = home + offset;
      if (budget_.is_spent() || !mesh_.can_move(v, uv)) return;  // so it stays inside the domain
      const SurfaceJet jet = ask(v.face, uv);
      Trial trial(mesh_);
      mesh_.move(v, uv, jet.s);
      criterion.learn(*this, v, jet);
      const Judgement now = judge();
      if (accepts(now, before) && now.better_than(best) && agree(fan, mean))
        best = now, found = {uv, jet.s, criterion.known(mesh_, v)};
      (void)trial.undo();
      criterion.set_known(mesh_, v, known);
    });
    return found;
  }

 private:
  const SizeRules& rules_;
  Cad& cad_;
  CompositeResult& result_;
  EditableMesh mesh_;
  Budget budget_;
  std::vector<Vertex> changed_;
};

}  // namespace carreau
