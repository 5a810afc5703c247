// SPDX-License-Identifier: BSD-3-Clause
#include "surface/improve/even_edges.h"

#include <optional>

#include "metric/unit_edge.h"
#include "surface/improve/chord_gradation.h"
#include "surface/improve/length_ratio.h"

namespace carreau {

namespace {

/// Moves vertices, swaps edges and divides edges until a criterion finds no uneven vertex.
template <typename Criterion>
class Evening {
 public:
  Evening(Criterion& criterion, std::span<const std::int32_t> uneven, const SizeRules& rules, Cad& cad,
          CompositeResult& result, Monitor& monitor)
      : criterion_(criterion), search_(uneven, rules, cad, result), mesh_(search_.mesh()), monitor_(monitor) {}

  void run(std::vector<std::int32_t> uneven) {
    // The cheapest changes first, everywhere.
    uneven = change_each(std::move(uneven), &Evening::move_one);
    uneven = change_each(std::move(uneven), &Evening::swap_one);
    if constexpr (Criterion::divides) {
      change_each(std::move(uneven), &Evening::divide_one);
    } else {
      range_ = {unit_edge::shortest_at_last, unit_edge::longest_at_last};
      uneven = change_each(std::move(uneven), &Evening::move_one);
      change_each(std::move(uneven), &Evening::swap_one);
    }
    search_.update_sizes(Criterion::size_of, monitor_);
  }

 private:
  using Vertex = EditableMesh::Vertex;
  using Quad = EditableMesh::Quad;
  using Judgement = EveningJudgement;
  using Found = AssembledSearch::Found<typename Criterion::Known>;

  [[nodiscard]] bool is_uneven(std::int32_t v) const { return criterion_.is_uneven(search_, v); }

  // Returns the vertices at which nothing helps.
  std::vector<std::int32_t> change_each(std::vector<std::int32_t> uneven, bool (Evening::*change)(std::int32_t)) {
    return improve_ring_by_ring(
        std::move(uneven), Criterion::rings, search_.budget(), monitor_, [this](std::int32_t v) { return is_uneven(v); },
        [this, change](std::int32_t v) { return (this->*change)(v); },
        [this](std::int32_t v) {
          std::vector<std::int32_t> left = search_.left_around(v);
          std::erase_if(left, [this](std::int32_t w) { return !is_uneven(w); });
          return left;
        });
  }

  [[nodiscard]] Judgement judge_around(Vertex v) const {
    return criterion_.judge_around(mesh_, mesh_.global(v), range_);
  }
  std::optional<Found> best_place(Vertex v, Judgement& best) {
    return search_.best_place(
        criterion_, v, [&] { return judge_around(v); },
        [](const Judgement& now, const Judgement& before) { return now.no_worse_than(before, Criterion::good); }, best);
  }
  void move(Vertex v, const Found& to) {
    mesh_.move(v, to.uv, to.xyz);
    criterion_.set_known(mesh_, v, to.known);
  }

  // Moves v or a vertex that the criterion adds, the vertex with the largest gain.
  bool move_one(std::int32_t v) {
    double most = 0;
    Vertex which{};
    std::optional<Found> where;
    for (const std::int32_t w : Criterion::movable_at(mesh_, v)) {
      const auto inside = mesh_.inside(w);
      if (!inside || !search_.is_sampled(inside->face)) continue;
      const Judgement before = judge_around(*inside);
      Judgement after;
      const auto found = best_place(*inside, after);
      if (!found || !after.improves(before, Criterion::good) || before.excess - after.excess <= most) continue;
      most = before.excess - after.excess, which = *inside, where = found;
    }
    if (!where) return false;
    move(which, *where);
    search_.note_changed(which);
    return true;
  }

  /// Calls `use` for each edge of the triangles around v that may go.
  template <typename Use>
  void for_edges_near(std::int32_t v, const Use& use) {
    const std::vector<EditableMesh::Place> places = mesh_.fan(v);
    for (const EditableMesh::Place p : places)
      for (int i = 0; i < 3; ++i)
        if (const auto quad = mesh_.quad(p, i); quad && search_.is_sampled(p.face)) use(*quad);
  }

  bool swap_one(std::int32_t v) {
    std::optional<Quad> found;
    Judgement best;
    for_edges_near(v, [&](const Quad& q) {
      const Judgement before = criterion_.judge_quad(mesh_, q, false, range_);
      if (!(before.excess > 0)) return;
      const Trial trial(mesh_);
      Judgement after;
      const bool better = search_.swap_if_better(
          q, before, Criterion::good, [&] { return criterion_.judge_quad(mesh_, q, true, range_); }, after);
      if (!better) return;
      if (!found || after.better_than(best)) found = q, best = after;
    });
    return found && mesh_.swap(*found);
  }

  Vertex divide(const Quad& q, const Vec2& uv, const Vec3& xyz) {
    const auto [a, b, c, d] = mesh_.corners(q);
    criterion_.add_between(a, b);
    return mesh_.split(q, uv, xyz);
  }

  /// The vertex that would divide an edge; its judgement must improve on the judgement of the edge.
  std::optional<Found> best_division(const Quad& q, Judgement& after) {
    const Vec2 middle = 0.5 * (mesh_.uv({q.face, q.a}) + mesh_.uv({q.face, q.b}));
    if (!mesh_.can_split(q, middle)) return {};
    constexpr LengthRange range{.shortest = unit_edge::shortest_at_last};
    const Judgement before = criterion_.judge(mesh_, mesh_.corners(q), range);
    const Vec3 mean = mesh_.mean_normal(q.places());
    Trial trial(mesh_);
    const SurfaceJet jet = search_.ask(q.face, middle);
    const Vertex v = divide(q, middle, jet.s);
    criterion_.learn(search_, v, jet);
    Found found{middle, jet.s, criterion_.known(mesh_, v)};
    for (int k = 0; k < thresholds::length_ratio::placements; ++k)
      if (const auto to = best_place(v, after)) move(v, found = *to);
    const std::int32_t m = mesh_.global(v);
    after = criterion_.judge_around(mesh_, m, range);
    const bool better = after.improves(before, Criterion::good) && search_.agree(mesh_.fan(m), mean);
    (void)trial.undo();
    criterion_.remove_last();
    return better ? std::optional(found) : std::nullopt;
  }

  // Between imposed vertices no other change may help.
  bool divide_one(std::int32_t v) {
    std::optional<Quad> quad;
    std::optional<Found> where;
    Judgement best;
    for_edges_near(v, [&](const Quad& q) {
      Judgement after;
      const auto found = best_division(q, after);
      if (found && (!quad || after.better_than(best))) quad = q, best = after, where = found;
    });
    if (!quad) return false;
    const Vertex middle = divide(*quad, where->uv, where->xyz);
    criterion_.set_known(mesh_, middle, where->known);
    search_.note_changed(middle);
    return true;
  }

  Criterion& criterion_;
  AssembledSearch search_;
  EditableMesh& mesh_;
  Monitor& monitor_;
  LengthRange range_;
};

template <typename Criterion>
void even_out(Criterion criterion, const SizeRules& rules, Cad& cad, CompositeResult& result, Monitor& monitor) {
  const std::vector<std::int32_t> uneven = criterion.find_uneven(monitor);
  if (!uneven.empty()) Evening(criterion, uneven, rules, cad, result, monitor).run(uneven);
}

}  // namespace

void even_out_lengths(double limit, const GeometricLimits& kept, const SizeRules& rules, Cad& cad, CompositeResult& result,
                      Monitor& monitor) {
  even_out(LengthRatio(limit, kept, result, cad, monitor), rules, cad, result, monitor);
}

void even_out_sizes(double limit, const GeometricLimits& kept, const SizeRules& rules, Cad& cad,
                    CompositeResult& result, Monitor& monitor) {
  even_out(ChordGradation(limit, kept, result, cad, monitor), rules, cad, result, monitor);
}

}  // namespace carreau
