// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/edits/remeshing.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <vector>

#include "metric/unit_edge.h"
#include "surface/remesh/base/thresholds.h"
#include "surface/remesh/edits/edge_edits.h"
#include "surface/remesh/edits/vertex_moves.h"

namespace carreau {

namespace {

using namespace thresholds::remesh;

struct LongEdge {
  double length;
  std::int32_t v, w;
};

class Remesher {
 public:
  Remesher(CrossPatchMesh& mesh, Monitor& monitor, bool everywhere, bool thorough)
      : mesh_(mesh),
        monitor_(monitor),
        everywhere_(everywhere),
        thorough_(thorough),
        mover_(mesh, thorough ? min_move_thorough : min_move) {}

  RemeshingReport halve() {
    activate_all();
    const auto old = static_cast<std::int32_t>(mesh_.vertices());
    split_long();
    // The first split edge of each triangle leads from its middle to a corner: swaps join the last middles.
    const auto last = static_cast<std::int32_t>(mesh_.vertices());
    for (std::int32_t m = old; m < last; ++m) {
      monitor_.checkpoint();
      for (const std::int32_t v : mesh_.mesh().ring(m)) {
        if (v >= old || mesh_.length(m, v) < longest_of_halves) continue;
        const auto q = quad_between(m, v);
        if (!q || q->c < old || q->d < old) continue;
        Change change;
        judge_swap(mesh_, *q, &CrossPatchMesh::judge, change);
        if (change.keeps_shapes(min_shape_of_degrees) && change.keeps_surface() && mesh_.swap(*q)) ++report_.swaps;
      }
    }
    return report_;
  }

  RemeshingReport polish(double below) {
    state_.assign(mesh_.vertices(), swap_due | move_due);
    know_new();
    for (std::size_t t = 0; t < mesh_.triangles().size(); ++t)
      if (mesh_.triangles()[t][0] >= 0 && shape_of({0, static_cast<std::int32_t>(t)}) < below)
        for (const std::int32_t v : mesh_.triangles()[t]) mark(v, active);
    report_.rounds = max_rounds_of_degrees;
    last_passes(max_rounds_of_degrees);
    return report_;
  }

  RemeshingReport run(std::span<const std::int32_t> around) {
    around.empty() ? activate_all() : activate_around(around);
    for (report_.rounds = 0; report_.rounds < max_rounds; ++report_.rounds) {
      const std::int64_t before = report_.collapses + report_.splits;
      collapse_edges(false);
      split_long();
      swap_all();
      move_all();
      collapse_edges(true);
      swap_all();
      move_all();
      swap_all();
      move_all();
      if (report_.collapses + report_.splits == before) break;
    }
    last_passes(thorough_ ? max_last_passes_thorough : max_rounds);
    return report_;
  }

 private:
  void last_passes(int most) {
    for (int pass = 0; pass < most; ++pass) {
      const std::int64_t before = report_.swaps + report_.moves;
      swap_all();
      move_all();
      if (report_.swaps + report_.moves == before) break;
    }
  }

  using Place = CrossPatchMesh::Place;
  using Quad = CrossPatchMesh::Quad;

  // State of a vertex: it is at work; a swap of its edges, or its move, is due. An edit is due if its surroundings have
  // changed since the last test.
  enum State : unsigned char { active = 1, swap_due = 2, move_due = 4, all_due = 7 };
  [[nodiscard]] bool is(std::int32_t v, State s) const { return (state_[v] & s) != 0; }
  void mark(std::int32_t v, unsigned s) { state_[v] = static_cast<unsigned char>(state_[v] | s); }
  void clear(std::int32_t v, State s) { state_[v] = static_cast<unsigned char>(state_[v] & ~s); }
  void know_new() {
    state_.resize(mesh_.vertices(), all_due);
    shape_.resize(mesh_.triangles().size(), unknown);
  }

  // Shapes of triangles stay valid until a corner moves or changes.
  static constexpr double unknown = -1;
  [[nodiscard]] double shape_of(Place p) {
    double& known = shape_[p.triangle];
    if (known != unknown) return known;
    const auto& t = mesh_.mesh().at(p);
    TriangleShapes here;
    mesh_.judge_shape(t[0], t[1], t[2], here);
    return known = here.worst;
  }
  void forget_shapes(std::int32_t v) {
    for (const Place p : mesh_.mesh().fan(v)) shape_[p.triangle] = unknown;
  }

  // Activates the corners of bad triangles, and their surroundings.
  void activate_all() {
    state_.assign(mesh_.vertices(), everywhere_ ? all_due : swap_due | move_due);
    if (everywhere_) return;
    for (const auto& t : mesh_.triangles()) {
      if (t[0] < 0) continue;
      if (is_bad(mesh_, t))
        for (const std::int32_t v : t) mark(v, active);
    }
    widen();
    widen();
  }

  // Activates the surroundings of these vertices.
  void activate_around(std::span<const std::int32_t> vertices) {
    state_.assign(mesh_.vertices(), swap_due | move_due);
    for (const std::int32_t v : vertices) mark(v, active);
    widen();
    widen();
  }

  void widen() {
    std::vector<unsigned char> wider = state_;
    for (const auto& t : mesh_.triangles())
      if (t[0] >= 0 && (is(t[0], active) || is(t[1], active) || is(t[2], active)))
        for (const std::int32_t v : t) wider[v] |= active;
    state_ = std::move(wider);
  }

  // After an edit: v has gone somewhere else ...
  void moved(std::int32_t v) {
    forget_shapes(v);
    mark_ring(v, all_due);
  }
  // ... has other triangles ...
  void swapped(std::int32_t v) {
    mark_ring(v, active | swap_due);
    mark(v, move_due);
  }
  // ... or so have all around it, too.
  void remade(std::int32_t v) {
    know_new();
    forget_shapes(v);
    mark_ring(v, active | move_due);
    for (const Place p : mesh_.mesh().fan(v))
      for (const std::int32_t w : mesh_.mesh().at(p)) mark_ring(w, swap_due);
  }
  void mark_ring(std::int32_t v, unsigned s) {
    for (const Place p : mesh_.mesh().fan(v))
      for (const std::int32_t w : mesh_.mesh().at(p)) mark(w, s);
  }

  /// Edges between vertices at work whose length satisfies `wanted`, in the order `before`.
  template <typename Wanted, typename Before>
  std::vector<LongEdge> edges(const Wanted& wanted, const Before& before) {
    know_new();
    std::vector<LongEdge> found;
    for (const auto& t : mesh_.triangles()) {
      if (t[0] < 0) continue;
      for (int i = 0; i < 3; ++i) {
        const std::int32_t v = t[i], w = t[(i + 1) % 3];
        if (!is(v, active) && !is(w, active)) continue;
        if (v > w && (mesh_.is_free(v) || mesh_.is_free(w))) continue;  // of two triangles: met from the other one
        const double l = mesh_.length(v, w);
        if (!wanted(l) || (v > w && has_twin(v, w))) continue;
        found.push_back({l, std::min(v, w), std::max(v, w)});
      }
    }
    std::ranges::sort(found, [&](const LongEdge& p, const LongEdge& q) {
      return p.length != q.length ? before(p.length, q.length) : std::tie(p.v, p.w) < std::tie(q.v, q.w);
    });
    return found;
  }
  // The edge runs the other way, too.
  [[nodiscard]] bool has_twin(std::int32_t v, std::int32_t w) const {
    return std::ranges::any_of(mesh_.mesh().fan(w), [&](Place p) {
      const auto& t = mesh_.mesh().at(p);
      return (t[0] == w && t[1] == v) || (t[1] == w && t[2] == v) || (t[2] == w && t[0] == v);
    });
  }

  // `dense`: where triangles are smaller than equilateral triangles of unit length, though no edge is short, as long as triangles stay
  // no larger in the mean.
  void collapse_edges(bool dense) {
    const double below = dense ? short_when_dense : unit_edge::shortest;
    for (const LongEdge& e : edges([&](double l) { return l < below; }, std::less<>())) {
      monitor_.checkpoint();
      if (!mesh_.is_alive(e.v) || !mesh_.is_alive(e.w) || !(mesh_.length(e.v, e.w) < below)) continue;
      if (mesh_.mesh().is_imposed(e.v, e.w) || (dense && !is_dense(mesh_, e.v, e.w))) continue;  // line_remeshing
      const auto forth = shapes_after_collapse(mesh_, e.v, e.w, dense), back = shapes_after_collapse(mesh_, e.w, e.v, dense);
      const bool turned = back.worst > forth.worst;
      (turned ? collapse(e.w, e.v, back) : collapse(e.v, e.w, forth)) ||
          (turned ? collapse(e.v, e.w, forth) : collapse(e.w, e.v, back));
    }
  }

  bool collapse(std::int32_t gone, std::int32_t kept, const CollapseShapes& shapes) {
    if (shapes.worst < 0 || !collapse_edge(mesh_, gone, kept)) return false;
    mesh_.budget.pay(shapes.cost);
    remade(kept);
    ++report_.collapses;
    return true;
  }

  void split_long() {
    for (const LongEdge& e : edges([](double l) { return l > unit_edge::longest; }, std::greater<>())) {
      monitor_.checkpoint();
      const auto quad = quad_between(e.v, e.w);
      if (!quad || !(mesh_.length(e.v, e.w) > unit_edge::longest)) continue;
      const auto middle = split_edge(mesh_, *quad);
      if (!middle) continue;
      remade(*middle);
      ++report_.splits;
    }
  }

  [[nodiscard]] std::optional<Quad> quad_between(std::int32_t v, std::int32_t w) const {
    return mesh_.mesh().quad_between({0, v}, w);
  }

  void swap_all() {
    know_new();
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(mesh_.vertices()); ++v) {
      if (!is(v, active) || !is(v, swap_due) || !mesh_.is_alive(v)) continue;
      monitor_.checkpoint();
      clear(v, swap_due);
      swap_around(v);
    }
  }

  void swap_around(std::int32_t v) {
    know_spokes(v);
    bool left = false;  // for the other end
    for (std::size_t k = 0; k < spokes_.size(); ++k) {
      const Spoke e = spokes_[k];
      if (v > e.w && is(e.w, active)) {
        left = left || is(e.w, swap_due);
        continue;
      }
      if (e.c < 0 || e.d < 0 || !swap(v, e)) continue;
      look_at_spokes(v);
    }
    if (left) mark(v, swap_due);
  }

  // Edges from v with the corners beside them: c on the left, d on the right, -1: none; the worse shape beside.
  struct Spoke {
    std::int32_t w, c = -1, d = -1;
    double shape = 1;
  };
  Spoke& spoke_to(std::int32_t w) {
    for (Spoke& e : spokes_)
      if (e.w == w) return e;
    return spokes_.emplace_back(Spoke{w});
  }
  void know_spokes(std::int32_t v) {
    spokes_.clear();
    look_at_spokes(v);
  }
  // Updates the spokes after swaps, too; edges that have gone have no corners.
  void look_at_spokes(std::int32_t v) {
    for (Spoke& e : spokes_) e = Spoke{e.w};
    for (const Place p : mesh_.mesh().fan(v)) {
      const auto& t = mesh_.mesh().at(p);
      const int i = mesh_.mesh().rank_in(p, v);
      const std::int32_t j = t[(i + 1) % 3], k = t[(i + 2) % 3];
      const double here = shape_of(p);
      Spoke& first = spoke_to(j);
      first.c = k, first.shape = std::min(first.shape, here);
      Spoke& second = spoke_to(k);
      second.d = j, second.shape = std::min(second.shape, here);
    }
  }

  bool swap(std::int32_t v, const Spoke& e) {
    const bool for_degrees = report_.rounds < max_rounds_of_degrees && evens_degrees(mesh_, v, e.w, e.c, e.d);
    if (!for_degrees && e.shape >= shape_of_squares) return false;
    const auto q = quad_between(v, e.w);
    if (!q || !swap_edge(mesh_, *q, for_degrees)) return false;
    shape_[q->t] = shape_[q->u] = unknown;
    for (const std::int32_t k : {q->a, q->b, q->c, q->d}) swapped(k);
    ++report_.swaps;
    return true;
  }

  void move_all() {
    know_new();
    const std::vector<unsigned char> was = state_;
    for (unsigned char& state : state_) state = static_cast<unsigned char>(state & ~active);
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(was.size()); ++v) {
      if ((was[v] & active) == 0 || !is(v, move_due) || !mesh_.is_free(v) || !mesh_.is_alive(v)) continue;
      monitor_.checkpoint();
      clear(v, move_due);
      if (!mover_.move(v)) continue;
      moved(v);
      ++report_.moves;
    }
  }

  CrossPatchMesh& mesh_;
  Monitor& monitor_;
  bool everywhere_, thorough_;
  VertexMover mover_;
  std::vector<unsigned char> state_;  // by vertex
  std::vector<double> shape_;         // by triangle
  std::vector<Spoke> spokes_;         // of the vertex at work
  RemeshingReport report_;
};

}  // namespace

bool is_bad(const CrossPatchMesh& mesh, const EditableMesh::Triangle& t) {
  TriangleShapes shape;
  mesh.judge_shape(t[0], t[1], t[2], shape);
  bool bad = shape.worst < good_enough;
  for (int i = 0; i < 3; ++i) {
    const double l = mesh.length(t[i], t[(i + 1) % 3]);
    bad = bad || l < unit_edge::shortest || l > unit_edge::longest;
  }
  return bad;
}

RemeshingReport halve(CrossPatchMesh& mesh, Monitor& monitor) { return Remesher(mesh, monitor, true, true).halve(); }

RemeshingReport polish(CrossPatchMesh& mesh, double below, Monitor& monitor) {
  const ShapeBudget budget = mesh.budget;
  mesh.budget.left = 0;  // gains may be spent again
  const RemeshingReport report = Remesher(mesh, monitor, false, false).polish(below);
  mesh.budget = budget;
  return report;
}

RemeshingReport remesh(CrossPatchMesh& mesh, Monitor& monitor, bool everywhere, bool thorough,
                       std::span<const std::int32_t> around) {
  return Remesher(mesh, monitor, everywhere, thorough).run(around);
}

}  // namespace carreau
