// SPDX-License-Identifier: BSD-3-Clause
#include "surface/improve/adjacent_lengths.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "mesh/quality.h"
#include "support/infinity.h"
#include "surface/improve/assembled_search.h"
#include "surface/improve/thresholds.h"
#include "surface/sample/face_metric.h"

namespace carreau {

namespace {

using namespace thresholds::length_ratio;
using thresholds::assembled::longest;
using thresholds::assembled::shortest;

using Vertices = std::vector<std::int32_t>;

/// Vertices whose edges differ too much; all edges, by their squares.
Vertices find_uneven(double limit, const SurfaceMesh& mesh, Monitor& monitor) {
  std::vector<double> low(mesh.vertices.size(), infinity), high(low.size(), 0);
  for (const FaceMesh& face : mesh.faces) {
    monitor.checkpoint();
    for (const auto& t : face.triangles)
      for (int i = 0; i < 3; ++i) {
        const std::int32_t a = face.vertex[t[i]], b = face.vertex[t[i == 2 ? 0 : i + 1]];
        const Vec3 e = mesh.vertices[b] - mesh.vertices[a];
        const double l2 = dot(e, e);
        low[a] = std::min(low[a], l2), low[b] = std::min(low[b], l2);
        high[a] = std::max(high[a], l2), high[b] = std::max(high[b], l2);
      }
  }
  Vertices uneven;
  for (std::size_t v = 0; v < low.size(); ++v)
    if (high[v] > limit * limit * low[v]) uneven.push_back(static_cast<std::int32_t>(v));
  return uneven;
}

/// Of some vertices and the triangles around them.
struct Judgement {
  double excess = 0;   ///< of ratios of lengths over the limit, as a share of it
  int out = 0;         ///< edges that are too long or too short
  double quality = 1;  ///< of the worst triangle

  [[nodiscard]] bool better_than(const Judgement& other) const noexcept {
    if (std::abs(excess - other.excess) > rounding) return excess < other.excess;
    return out != other.out ? out < other.out : quality > other.quality;
  }
  /// Apart from the excess.
  [[nodiscard]] bool no_worse_than(const Judgement& before) const noexcept {
    return out <= before.out && quality >= std::min(before.quality, good);
  }
  [[nodiscard]] bool improves(const Judgement& before) const noexcept {
    return excess < before.excess - least_gain && no_worse_than(before);
  }
};

/// The criterion: ratios of lengths around vertices, and the sizes by which edges are too long or too short.
class LengthRatio {
 public:
  LengthRatio(double limit, const SurfaceMesh& positions, const AssembledSearch& search, std::vector<double>& sizes)
      : limit_(limit), positions_(positions), search_(search), mesh_(search.mesh()), size_(sizes) {}

  [[nodiscard]] double excess(std::int32_t v) const {
    double low = infinity, high = 0;
    for (const std::int32_t w : mesh_.ring(v)) {
      const double l = norm(positions_.vertices[w] - positions_.vertices[v]);
      low = std::min(low, l), high = std::max(high, l);
    }
    return std::max(0., high / (limit_ * low) - 1);
  }

  // `least`: edges are too short below.
  [[nodiscard]] Judgement judge(std::span<const std::int32_t> vertices, double least = shortest) const {
    Judgement sum;
    for (const std::int32_t v : vertices) {
      sum.excess += excess(v);
      for (const std::int32_t w : mesh_.ring(v)) {
        const double l = metric_length(v, w);
        sum.out += l < least || l > longest ? 1 : 0;
      }
      for (const EditableMesh::Place p : mesh_.fan(v)) {
        const auto& t = mesh_.at(p);
        const auto corner = [&](int i) { return mesh_.position(p.face, t[i]); };
        sum.quality = std::min(sum.quality, quality_q2(corner(0), corner(1), corner(2)));
      }
    }
    return sum;
  }

  // What is known of a vertex is its size.
  [[nodiscard]] double known(EditableMesh::Vertex v) const { return size_[mesh_.global(v)]; }
  void set_known(EditableMesh::Vertex v, double size) { size_[mesh_.global(v)] = size; }
  void learn(EditableMesh::Vertex v, const SurfaceJet& jet) {
    const double h = isotropic_size(jet, search_.metric(v.face, mesh_.uv(v)));
    if (h > 0) set_known(v, h);
  }

 private:
  // By the sizes at its ends, between which they are linear (RR-2818 sec. 5.2).
  [[nodiscard]] double metric_length(std::int32_t a, std::int32_t b) const {
    const double p = size_[a], q = size_[b], d = norm(positions_.vertices[b] - positions_.vertices[a]);
    return std::abs(q - p) > 1e-6 * p ? d * std::log(q / p) / (q - p) : d / p;
  }

  double limit_;
  const SurfaceMesh& positions_;
  const AssembledSearch& search_;
  const EditableMesh& mesh_;
  std::vector<double>& size_;
};

class LengthEvening {
 public:
  LengthEvening(double limit, const Vertices& uneven, const SizeRules& rules, Cad& cad, CompositeResult& result,
                Monitor& monitor)
      : search_(uneven, rules, cad, result),
        mesh_(search_.mesh()),
        size_(result.vertex_size),
        ratio_(limit, result.mesh, search_, size_),
        monitor_(monitor) {}

  void run(Vertices uneven) {
    // The cheapest first, everywhere.
    for (const auto change : {&LengthEvening::move_one, &LengthEvening::swap_one, &LengthEvening::divide_one})
      uneven = improve_ring_by_ring(
          std::move(uneven), {}, search_.budget(), monitor_, [this](std::int32_t v) { return is_uneven(v); },
          [this, change](std::int32_t v) { return (this->*change)(v); },
          [this](std::int32_t v) {
            Vertices left = search_.left_around(v);
            std::erase_if(left, [this](std::int32_t w) { return !is_uneven(w); });
            return left;
          });
    search_.update_sizes(isotropic_size, monitor_);
  }

 private:
  using Vertex = EditableMesh::Vertex;
  using Place = EditableMesh::Place;
  using Quad = EditableMesh::Quad;
  using Found = AssembledSearch::Found<double>;

  [[nodiscard]] bool is_uneven(std::int32_t v) const { return ratio_.excess(v) > 0; }

  // By the judgement of the vertex and its neighbours.
  std::optional<Found> best_place(Vertex v, Judgement& best) {
    const Vertices around = mesh_.with_ring(mesh_.global(v));
    const auto accepts = [](const Judgement& now, const Judgement& before) { return now.no_worse_than(before); };
    return search_.best_place(
        ratio_, v, [&] { return ratio_.judge(around); }, accepts, best);
  }

  void move(Vertex v, const Found& to) {
    mesh_.move(v, to.uv, to.xyz);
    ratio_.set_known(v, to.known);
  }

  // Of v and its neighbours the one that gains most.
  bool move_one(std::int32_t v) {
    double most = 0;
    Vertex which{};
    std::optional<Found> where;
    for (const std::int32_t w : mesh_.with_ring(v)) {
      const auto inside = mesh_.inside(w);
      if (!inside || !search_.is_sampled(inside->face)) continue;
      const Judgement before = ratio_.judge(mesh_.with_ring(w));
      Judgement after;
      const auto found = best_place(*inside, after);
      if (!found || !after.improves(before) || before.excess - after.excess <= most) continue;
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
    const std::vector<Place> places = mesh_.fan(v);
    for (const Place p : places)
      for (int i = 0; i < 3; ++i)
        if (const auto quad = mesh_.quad(p, i); quad && search_.is_sampled(p.face)) use(*quad);
  }

  bool swap_one(std::int32_t v) {
    std::optional<Quad> found;
    Judgement best;
    for_edges_near(v, [&](const Quad& q) {
      const auto around = mesh_.corners(q);
      const std::size_t edits = mesh_.edits();
      Judgement after;
      if (!search_.swap_if_better(
              q, ratio_.judge(around), [&] { return ratio_.judge(around); }, after))
        return;
      if (!found || after.better_than(best)) found = q, best = after;
      mesh_.undo(edits);
    });
    return found && mesh_.swap(*found);
  }

  // With the size of the middle, for want of a better one.
  Vertex divide(const Quad& q, const Vec2& uv, const Vec3& xyz) {
    const auto [a, b, c, d] = mesh_.corners(q);
    size_.push_back(0.5 * (size_[a] + size_[b]));
    return mesh_.split(q, uv, xyz);
  }

  /// The vertex that would divide an edge; its judgement is to improve that of the edge.
  std::optional<Found> best_division(const Quad& q, Judgement& after) {
    const Vec2 middle = 0.5 * (mesh_.uv({q.face, q.a}) + mesh_.uv({q.face, q.b}));
    if (!mesh_.can_split(q, middle)) return {};
    const Judgement before = ratio_.judge(mesh_.corners(q), shortest_divided);
    const Vec3 mean = mesh_.mean_normal(q.places());
    const std::size_t edits = mesh_.edits();
    const SurfaceJet jet = search_.ask(q.face, middle);
    const Vertex v = divide(q, middle, jet.s);
    Found found{middle, jet.s, 0};
    ratio_.learn(v, jet);
    found.known = ratio_.known(v);
    for (int k = 0; k < placements; ++k)
      if (const auto to = best_place(v, after)) move(v, found = *to);
    const std::int32_t m = mesh_.global(v);
    after = ratio_.judge(mesh_.with_ring(m), shortest_divided);
    const bool better = after.improves(before) && search_.agree(mesh_.fan(m), mean);
    mesh_.undo(edits);
    size_.pop_back();
    return better ? std::optional(found) : std::nullopt;
  }

  // Between imposed vertices nothing else may help.
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
    ratio_.set_known(middle, where->known);
    search_.note_changed(middle);
    return true;
  }

  AssembledSearch search_;
  EditableMesh& mesh_;
  std::vector<double>& size_;
  LengthRatio ratio_;
  Monitor& monitor_;
};

}  // namespace

void even_out_lengths(double limit, const SizeRules& rules, Cad& cad, CompositeResult& result, Monitor& monitor) {
  const double rounded = (1 - rounding) * limit;
  Vertices uneven = find_uneven(rounded, result.mesh, monitor);
  if (uneven.empty()) return;
  LengthEvening(rounded, uneven, rules, cad, result, monitor).run(uneven);
}

}  // namespace carreau
