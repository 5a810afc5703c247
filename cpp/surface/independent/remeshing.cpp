// SPDX-License-Identifier: BSD-3-Clause
#include "surface/independent/remeshing.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <vector>

#include "metric/metric2.h"
#include "surface/independent/collapse_price.h"
#include "surface/independent/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::independent;

/// HDR eq. 4.84.
double edge_quality(double length) noexcept { return length <= 1 ? length : 1 / length; }

struct LongEdge {
  double length;
  std::int32_t v, w;
};

class Remesher {
 public:
  Remesher(FreeMesh& mesh, Monitor& monitor, bool everywhere, bool thorough)
      : mesh_(mesh), monitor_(monitor), everywhere_(everywhere), thorough_(thorough) {}

  RemeshingReport halve() {
    activate_all();
    const auto old = static_cast<std::int32_t>(mesh_.vertices());
    split_long();
    // Of each triangle the first edge that was split leads from its middle to a corner: the last middles are to be joined.
    const auto last = static_cast<std::int32_t>(mesh_.vertices());
    for (std::int32_t m = old; m < last; ++m) {
      monitor_.checkpoint();
      for (const std::int32_t v : mesh_.mesh().ring(m)) {
        if (v >= old || mesh_.length(m, v) < longest_of_halves) continue;
        const auto q = quad_between(m, v);
        if (!q || q->c < old || q->d < old) continue;
        TriangleShapes before, after;
        mesh_.judge(q->a, q->b, q->c, before), mesh_.judge(q->b, q->a, q->d, before);
        mesh_.judge(q->a, q->d, q->c, after), mesh_.judge(q->d, q->b, q->c, after);
        if (after.worst >= std::min(before.worst, least_shape_of_degrees) && FreeMesh::agrees(before, after) && mesh_.swap(*q))
          ++report_.swaps;
      }
    }
    return report_;
  }

  RemeshingReport run(std::span<const std::int32_t> around) {
    around.empty() ? activate_all() : activate_around(around);
    for (report_.rounds = 0; report_.rounds < most_rounds; ++report_.rounds) {
      const std::int64_t before = report_.collapses + report_.splits;
      collapse_short();
      split_long();
      swap_all();
      move_all();
      thin_out();
      swap_all();
      move_all();
      swap_all();
      move_all();
      if (report_.collapses + report_.splits == before) break;
    }
    const int passes = thorough_ ? most_last_passes_thorough : most_last_passes;
    for (int pass = 0; pass < passes; ++pass) {
      const std::int64_t before = report_.swaps + report_.moves;
      swap_all();
      move_all();
      if (report_.swaps + report_.moves == before) break;
    }
    return report_;
  }

 private:
  using Place = FreeMesh::Place;
  using Quad = FreeMesh::Quad;

  // What is known of a vertex: it is at work; what decides on a swap of its edges, or on its move, has changed since
  // these were tried the last time.
  enum State : unsigned char { active = 1, swap_due = 2, move_due = 4, all_due = 7 };
  [[nodiscard]] bool is(std::int32_t v, State s) const { return (state_[v] & s) != 0; }
  void mark(std::int32_t v, unsigned s) { state_[v] = static_cast<unsigned char>(state_[v] | s); }
  void clear(std::int32_t v, State s) { state_[v] = static_cast<unsigned char>(state_[v] & ~s); }
  void know_new() { state_.resize(mesh_.vertices(), all_due); }

  // What is bad, and what is around.
  void activate_all() {
    state_.assign(mesh_.vertices(), everywhere_ ? all_due : swap_due | move_due);
    if (everywhere_) return;
    for (const auto& t : mesh_.triangles()) {
      if (t[0] < 0) continue;
      TriangleShapes shape;
      mesh_.judge_shape(t[0], t[1], t[2], shape);
      bool bad = shape.worst < good_enough;
      for (int i = 0; i < 3; ++i) {
        const double l = mesh_.length(t[i], t[(i + 1) % 3]);
        bad = bad || l < shortest || l > longest;
      }
      if (bad)
        for (const std::int32_t v : t) mark(v, active);
    }
    widen();
    widen();
  }

  // What is around these.
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
  void moved(std::int32_t v) { mark_ring(v, all_due); }
  // ... has other triangles ...
  void swapped(std::int32_t v) {
    mark_ring(v, active | swap_due);
    mark(v, move_due);
  }
  // ... or so have all around it, too.
  void remade(std::int32_t v) {
    know_new();
    mark_ring(v, active | move_due);
    for (const Place p : mesh_.mesh().fan(v))
      for (const std::int32_t w : mesh_.mesh().at(p)) mark_ring(w, swap_due);
  }
  void mark_ring(std::int32_t v, unsigned s) {
    for (const Place p : mesh_.mesh().fan(v))
      for (const std::int32_t w : mesh_.mesh().at(p)) mark(w, s);
  }

  /// Edges between vertices at work whose length is `wanted`, in this order.
  template <typename Wanted, typename Before>
  std::vector<LongEdge> edges(const Wanted& wanted, const Before& before) {
    know_new();
    std::vector<LongEdge> found;
    for (const auto& t : mesh_.triangles()) {
      if (t[0] < 0) continue;
      for (int i = 0; i < 3; ++i) {
        const std::int32_t v = t[i], w = t[(i + 1) % 3];
        if (!is(v, active) && !is(w, active)) continue;
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

  void collapse_short() {
    for (const LongEdge& e : edges([](double l) { return l < shortest; }, std::less<>())) {
      monitor_.checkpoint();
      if (!mesh_.is_alive(e.v) || !mesh_.is_alive(e.w) || !(mesh_.length(e.v, e.w) < shortest)) continue;
      if (mesh_.mesh().is_imposed(e.v, e.w)) continue;  // line_remeshing
      const auto forth = worst_after(e.v, e.w), back = worst_after(e.w, e.v);
      const bool turned = back > forth;
      (turned ? collapse(e.w, e.v, back) : collapse(e.v, e.w, forth)) ||
          (turned ? collapse(e.v, e.w, forth) : collapse(e.w, e.v, back));
    }
  }

  /// The worst shape that a collapse leaves; negative where it may not be.
  [[nodiscard]] double worst_after(std::int32_t gone, std::int32_t kept) const {
    const EditableMesh& mesh = mesh_.mesh();
    const double short_one = mesh_.length(gone, kept);
    TriangleShapes before, after;
    bool adjacent = false;
    for (const Place p : mesh.fan(gone)) {
      const auto t = mesh.at(p);
      if (t[0] == kept || t[1] == kept || t[2] == kept) {
        adjacent = true;
        continue;
      }
      mesh_.judge_shape(t[0], t[1], t[2], before);
      const int i = mesh.rank_in(p, gone);
      for (const std::int32_t w : {t[(i + 1) % 3], t[(i + 2) % 3]}) {
        const double l = mesh_.length(kept, w);
        if (l > longest && (l > never_longer || 1 / l < short_one)) return -1;
      }
      mesh_.judge_shape(kept, t[(i + 1) % 3], t[(i + 2) % 3], after);
    }
    if (!adjacent || after.worst < std::min(before.worst, least_shape)) return -1;
    if (costs_too_much(mesh_, gone, kept, before, after)) return -1;
    return after.worst;
  }

  /// Whether a collapse leaves the surface no farther than may be.
  [[nodiscard]] bool agrees_after(std::int32_t gone, std::int32_t kept) const {
    TriangleShapes before, after;
    for (const Place p : mesh_.mesh().fan(gone)) {
      const auto& t = mesh_.mesh().at(p);
      if (t[0] == kept || t[1] == kept || t[2] == kept) continue;
      mesh_.judge_agreement(t[0], t[1], t[2], before);
      const int i = mesh_.mesh().rank_in(p, gone);
      mesh_.judge_agreement(kept, t[(i + 1) % 3], t[(i + 2) % 3], after);
    }
    return FreeMesh::agrees(before, after);
  }

  // Where triangles are smaller than equilateral ones of unit length, though no edge is short: while triangles stay no
  // larger in the mean.
  void thin_out() {
    for (const LongEdge& e : edges([](double l) { return l < short_when_dense; }, std::less<>())) {
      monitor_.checkpoint();
      if (!mesh_.is_alive(e.v) || !mesh_.is_alive(e.w) || !(mesh_.length(e.v, e.w) < short_when_dense)) continue;
      if (mesh_.mesh().is_imposed(e.v, e.w) || !is_dense(e.v, e.w)) continue;
      const auto forth = worst_when_dense(e.v, e.w), back = worst_when_dense(e.w, e.v);
      const bool turned = back > forth;
      (turned ? collapse(e.w, e.v, back) : collapse(e.v, e.w, forth)) ||
          (turned ? collapse(e.v, e.w, forth) : collapse(e.w, e.v, back));
    }
  }

  // Without two of the triangles around.
  [[nodiscard]] bool is_dense(std::int32_t v, std::int32_t w) const {
    const EditableMesh& mesh = mesh_.mesh();
    double area = 0;
    int count = -2;
    for (const std::int32_t end : {v, w})
      for (const Place p : mesh.fan(end)) {
        const auto& t = mesh.at(p);
        if (end == w && (t[0] == v || t[1] == v || t[2] == v)) continue;
        area += mesh_.double_area(t) / 2;
        ++count;
      }
    return area <= 0.5 * half_root3 * count * most_mean_area;
  }

  [[nodiscard]] double worst_when_dense(std::int32_t gone, std::int32_t kept) const {
    if (!mesh_.is_free(gone)) return -1;
    const EditableMesh& mesh = mesh_.mesh();
    TriangleShapes before, after;
    for (const Place p : mesh.fan(gone)) {
      const auto t = mesh.at(p);
      if (t[0] == kept || t[1] == kept || t[2] == kept) continue;
      mesh_.judge_shape(t[0], t[1], t[2], before);
      const int i = mesh.rank_in(p, gone);
      for (const std::int32_t w : {t[(i + 1) % 3], t[(i + 2) % 3]})
        if (mesh_.length(kept, w) > never_longer) return -1;
      mesh_.judge_shape(kept, t[(i + 1) % 3], t[(i + 2) % 3], after);
    }
    if (after.worst < least_shape_when_dense || costs_too_much(mesh_, gone, kept, before, after)) return -1;
    return after.worst;
  }

  bool collapse(std::int32_t gone, std::int32_t kept, double worst) {
    if (worst < 0 || !agrees_after(gone, kept) || !mesh_.collapse(gone, kept)) return false;
    remade(kept);
    ++report_.collapses;
    return true;
  }

  void split_long() {
    for (const LongEdge& e : edges([](double l) { return l > longest; }, std::greater<>())) {
      monitor_.checkpoint();
      const auto quad = quad_between(e.v, e.w);
      if (quad && mesh_.length(e.v, e.w) > longest && split(*quad)) ++report_.splits;
    }
  }

  [[nodiscard]] std::optional<Quad> quad_between(std::int32_t v, std::int32_t w) const {
    return mesh_.mesh().quad_between({0, v}, w);
  }

  bool split(const Quad& q) {
    const Vec3 middle = 0.5 * (mesh_.position(q.a) + mesh_.position(q.b));
    const Vec3 normal = mesh_.mesh().mean_normal(q.places());
    auto at = mesh_.near(q.a, normal, middle);
    if (!at) at = mesh_.near(q.b, normal, middle);
    if (!at) return false;
    TriangleShapes before, after;
    mesh_.judge(q.a, q.b, q.c, before), mesh_.judge(q.b, q.a, q.d, before);
    const double was = edge_quality(mesh_.length(q.a, q.b));
    const std::int32_t m = mesh_.try_vertex(*at);
    double least = 1;
    for (const std::int32_t v : {q.a, q.b, q.c, q.d}) least = std::min(least, edge_quality(mesh_.length(m, v)));
    for (const auto& [v, w] : {std::pair{q.a, q.c}, std::pair{q.c, q.b}, std::pair{q.b, q.d}, std::pair{q.d, q.a}})
      mesh_.judge(w, v, m, after);
    mesh_.forget_vertex();
    if (least <= was || !FreeMesh::agrees(before, after) || after.worst < std::min(before.worst, least_shape))
      return false;
    remade(mesh_.split(q, *at));
    return true;
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

  // The edges from v, by their other ends.
  void swap_around(std::int32_t v) {
    know_spokes(v);
    bool left = false;  // for the other end
    for (std::size_t k = 0; k < spokes_.size(); ++k) {
      const Spoke e = spokes_[k];
      if (v > e.w && is(e.w, active)) {
        left = left || is(e.w, swap_due);
        continue;
      }
      if (e.c < 0 || e.d < 0 || is_too_long(v, e.w, e.c, e.d) || !swap(v, e.w)) continue;
      renew_spokes(v);
    }
    if (left) mark(v, swap_due);
  }

  // Edges from v with the corners beside them: c on the left, d on the right, -1: none.
  struct Spoke {
    std::int32_t w, c = -1, d = -1;
  };
  void know_spokes(std::int32_t v) {
    spokes_.clear();
    const auto to = [&](std::int32_t w) -> Spoke& {
      for (Spoke& e : spokes_)
        if (e.w == w) return e;
      return spokes_.emplace_back(Spoke{w});
    };
    for (const Place p : mesh_.mesh().fan(v)) {
      const auto& t = mesh_.mesh().at(p);
      const int i = mesh_.mesh().rank_in(p, v);
      const std::int32_t j = t[(i + 1) % 3], k = t[(i + 2) % 3];
      to(j).c = k;
      to(k).d = j;
    }
    std::ranges::sort(spokes_, {}, &Spoke::w);
  }
  // After swaps; edges that are no more have no corners.
  void renew_spokes(std::int32_t v) {
    for (Spoke& e : spokes_) e.c = e.d = -1;
    for (const Place p : mesh_.mesh().fan(v)) {
      const auto& t = mesh_.mesh().at(p);
      const int i = mesh_.mesh().rank_in(p, v);
      const std::int32_t j = t[(i + 1) % 3], k = t[(i + 2) % 3];
      for (Spoke& e : spokes_) {
        if (e.w == j) e.c = k;
        if (e.w == k) e.d = j;
      }
    }
  }

  [[nodiscard]] bool is_too_long(std::int32_t v, std::int32_t w, std::int32_t c, std::int32_t d) const {
    const double l = mesh_.length(c, d);
    return l > longest && l > mesh_.length(v, w);
  }

  bool swap(std::int32_t v, std::int32_t w) {
    const auto q = quad_between(v, w);
    if (!q || is_too_long(v, w, q->c, q->d)) return false;
    TriangleShapes before, after;
    mesh_.judge_shape(q->a, q->b, q->c, before), mesh_.judge_shape(q->b, q->a, q->d, before);
    mesh_.judge_shape(q->a, q->d, q->c, after), mesh_.judge_shape(q->d, q->b, q->c, after);
    const bool better = after.worst >= before.worst + least_gain ||
                        (after.worst >= least_shape_of_degrees && evens_degrees(*q));
    if (!better) return false;
    mesh_.judge_agreement(q->a, q->b, q->c, before), mesh_.judge_agreement(q->b, q->a, q->d, before);
    mesh_.judge_agreement(q->a, q->d, q->c, after), mesh_.judge_agreement(q->d, q->b, q->c, after);
    if (!FreeMesh::agrees(before, after) || !mesh_.swap(*q)) return false;
    for (const std::int32_t k : {q->a, q->b, q->c, q->d}) swapped(k);
    ++report_.swaps;
    return true;
  }

  // Towards six edges at each vertex.
  [[nodiscard]] bool evens_degrees(const Quad& q) const {
    if (report_.rounds >= most_rounds_of_degrees) return false;
    const auto excess = [&](std::int32_t v) {
      return mesh_.is_free(v) ? static_cast<int>(mesh_.mesh().fan(v).size()) - 6 : 0;
    };
    if (!mesh_.is_free(q.a) || !mesh_.is_free(q.b)) return false;
    // Moving one edge from a and b to c and d.
    int gain = 0;
    for (const std::int32_t v : {q.a, q.b}) gain += 2 * excess(v) - 1;
    for (const std::int32_t v : {q.c, q.d}) gain -= mesh_.is_free(v) ? 2 * excess(v) + 1 : 1;
    return gain > 0;
  }

  void move_all() {
    know_new();
    const std::vector<unsigned char> was = state_;
    for (unsigned char& state : state_) state = static_cast<unsigned char>(state & ~active);
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(was.size()); ++v) {
      if ((was[v] & active) == 0 || !is(v, move_due) || !mesh_.is_free(v) || !mesh_.is_alive(v)) continue;
      monitor_.checkpoint();
      clear(v, move_due);
      if (!move(v)) continue;
      moved(v);
      ++report_.moves;
    }
  }

  // The mean of the places where each triangle around would be equilateral, its sides the mean of the one that stays
  // and of the wanted one.
  [[nodiscard]] Vec3 ideal_place(std::int32_t v) const {
    Vec3 sum{0, 0, 0};
    double count = 0;
    for (const Place p : mesh_.mesh().fan(v)) {
      const auto& t = mesh_.mesh().at(p);
      const int i = mesh_.mesh().rank_in(p, v);
      const std::int32_t j = t[(i + 1) % 3], k = t[(i + 2) % 3];
      const Vec3 a = mesh_.position(j), b = mesh_.position(k), side = b - a, up = mesh_.position(v) - a;
      const double l = norm(side);
      const Vec3 across = up - (dot(up, side) / (l * l)) * side;
      const double height = norm(across);
      if (!(l > 0) || !(height > 0)) continue;
      const double wanted = 0.5 * (l + 0.5 * (mesh_.size(j) + mesh_.size(k)));
      sum = sum + 0.5 * (a + b) + (half_root3 * wanted / height) * across;
      count += 1;
    }
    return count > 0 ? Vec3(sum / count) : mesh_.position(v);
  }

  // The same in the mean metric of each triangle.
  [[nodiscard]] Vec3 ideal_place_by_direction(std::int32_t v) const {
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
      sum = sum + 0.5 * (a + b) + (half_root3 * wanted / std::sqrt(height2)) * across;
      count += 1;
    }
    return count > 0 ? Vec3(sum / count) : mesh_.position(v);
  }

  [[nodiscard]] int out_of_range(std::int32_t v) const {
    int out = 0;
    for (const Place p : mesh_.mesh().fan(v)) {  // of a free vertex: each neighbour once
      const double l = mesh_.length(v, mesh_.mesh().at(p)[(mesh_.mesh().rank_in(p, v) + 1) % 3]);
      out += l < shortest || l > longest ? 1 : 0;
    }
    return out;
  }

  bool move(std::int32_t v) {
    const SurfacePlace from = mesh_.place(v);
    const WantedSize size = mesh_.wanted(v);
    const Vec3 ideal = mesh_.by_direction() ? ideal_place_by_direction(v) : ideal_place(v);
    const Vec3 way = ideal - from.xyz;
    const double least = thorough_ ? least_move_thorough : least_move;
    if (mesh_.by_direction() ? length(size.metric, way) < least : norm(way) < least * size.h) return false;
    const TriangleShapes before = mesh_.judge_shapes_around(v);
    const int out = out_of_range(v);
    for (const double share : {1.0, 0.4}) {
      const auto to = mesh_.near(v, from.normal, lerp(from.xyz, ideal, share));
      if (!to) continue;
      mesh_.put(v, *to, mesh_.wanted_at(*to));
      const TriangleShapes after = mesh_.judge_shapes_around(v);
      if (after.inverses < before.inverses - least_gain && after.worst >= std::min(before.worst, good_enough) &&
          out_of_range(v) <= out && agrees_from(v, from, size))
        return true;
      mesh_.put(v, from, size);
    }
    return false;
  }

  // With the surface, at its place as well as at the one that it comes from.
  [[nodiscard]] bool agrees_from(std::int32_t v, const SurfacePlace& from, const WantedSize& size) {
    const TriangleShapes after = mesh_.judge_agreement_around(v);
    if (after.share <= 1) return true;
    const SurfacePlace to = mesh_.place(v);
    const WantedSize there = mesh_.wanted(v);
    mesh_.put(v, from, size);
    const TriangleShapes before = mesh_.judge_agreement_around(v);
    mesh_.put(v, to, there);
    return FreeMesh::agrees(before, after);
  }

  FreeMesh& mesh_;
  Monitor& monitor_;
  bool everywhere_, thorough_;
  std::vector<unsigned char> state_;  // by vertex
  std::vector<Spoke> spokes_;         // of the vertex at work
  RemeshingReport report_;
};

}  // namespace

RemeshingReport halve(FreeMesh& mesh, Monitor& monitor) { return Remesher(mesh, monitor, true, true).halve(); }

RemeshingReport remesh(FreeMesh& mesh, Monitor& monitor, bool everywhere, bool thorough,
                       std::span<const std::int32_t> around) {
  return Remesher(mesh, monitor, everywhere, thorough).run(around);
}

}  // namespace carreau
