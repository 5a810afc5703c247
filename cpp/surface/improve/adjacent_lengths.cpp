#include "surface/improve/adjacent_lengths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>

#include "mesh/quality.h"
#include "surface/improve/local_mesh.h"
#include "surface/sample/face_metric.h"

namespace carreau {

namespace {

// Rounding of the lengths that are compared.
constexpr double rounding = 1e-9;
// What a change must gain, in the sum of the excesses: so that changes come to an end.
constexpr double least_gain = 1e-4;
// Triangles of this quality are good whatever they were before.
constexpr double good_quality = 0.7;
// Lengths in the metric of a unit mesh.
constexpr double shortest = std::numbers::sqrt2 / 2, longest = std::numbers::sqrt2;
// A vertex put where nothing else helps, between imposed ones, may make edges as short as this.
constexpr double shortest_divided = 0.5;
// Cosine of the angle between a new triangle and the mean of those that it replaces.
constexpr double least_agreement = 0.7;
// A change beside a vertex is judged by what is around its neighbours' neighbours; one beside these may follow.
constexpr int rings = 3;
constexpr int placements = 4;  // of a new vertex
// Points of surfaces that may be asked, whatever the mesh, and for each vertex of larger ones: a model whose curves
// contradict its sizes leaves uneven vertices everywhere.
constexpr double least_budget = 5'000, budget_a_vertex = 0.25;

class LengthEvening {
 public:
  LengthEvening(double limit, const SizeRules& rules, Cad& cad, CompositeResult& result, Monitor& monitor)
      : limit_((1 - rounding) * limit),
        rules_(rules),
        cad_(cad),
        result_(result),
        mesh_(result.mesh),
        size_(result.vertex_size),
        monitor_(monitor) {}

  void run() {
    std::vector<std::int32_t> uneven = find_uneven();
    if (uneven.empty()) return;
    local_.emplace(mesh_, uneven, rings);
    left_ =
        static_cast<std::int64_t>(std::max(least_budget, budget_a_vertex * static_cast<double>(mesh_.vertices.size())));
    // The cheapest first, everywhere.
    for (const auto change : {&LengthEvening::move_one, &LengthEvening::swap_one, &LengthEvening::divide_one})
      mend(uneven, change);
    ask_sizes();
  }

 private:
  using Vertex = LocalMesh::Vertex;
  using Place = LocalMesh::Place;
  using Quad = LocalMesh::Quad;
  using Vertices = std::vector<std::int32_t>;
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
      return out <= before.out && quality >= std::min(before.quality, good_quality);
    }
    [[nodiscard]] bool improves(const Judgement& before) const noexcept {
      return excess < before.excess - least_gain && no_worse_than(before);
    }
  };
  struct State {  ///< what moves change
    Vec2 uv;
    Vec3 xyz;
    double size = 0;
  };

  // Those that are still uneven remain in the list.
  void mend(Vertices& uneven, bool (LengthEvening::*change)(std::int32_t)) {
    for (std::size_t k = 0; k < uneven.size() && left_ > 0; ++k) {
      monitor_.checkpoint();
      const std::int32_t v = uneven[k];
      if (!(excess(v) > 0) || !(this->*change)(v)) continue;
      // What is left of it, or has been left to others.
      for (const std::int32_t w : with_ring(v))
        if (local_->is_known(w) && excess(w) > 0) uneven.push_back(w);
    }
    std::erase_if(uneven, [this](std::int32_t v) { return !(excess(v) > 0); });
    std::sort(uneven.begin(), uneven.end());
    uneven.erase(std::unique(uneven.begin(), uneven.end()), uneven.end());
  }

  // All edges, by their squares.
  [[nodiscard]] Vertices find_uneven() const {
    std::vector<double> low(mesh_.vertices.size(), std::numeric_limits<double>::infinity()), high(low.size(), 0);
    for (const FaceMesh& face : mesh_.faces) {
      monitor_.checkpoint();
      for (const auto& t : face.triangles)
        for (int i = 0; i < 3; ++i) {
          const std::int32_t a = face.vertex[t[i]], b = face.vertex[t[i == 2 ? 0 : i + 1]];
          const Vec3 e = mesh_.vertices[b] - mesh_.vertices[a];
          const double l2 = dot(e, e);
          low[a] = std::min(low[a], l2), low[b] = std::min(low[b], l2);
          high[a] = std::max(high[a], l2), high[b] = std::max(high[b], l2);
        }
    }
    Vertices uneven;
    for (std::size_t v = 0; v < low.size(); ++v)
      if (high[v] > limit_ * limit_ * low[v]) uneven.push_back(static_cast<std::int32_t>(v));
    return uneven;
  }

  [[nodiscard]] double excess(std::int32_t v) const {
    double low = std::numeric_limits<double>::infinity(), high = 0;
    for (const std::int32_t w : local_->ring(v)) {
      const double l = norm(mesh_.vertices[w] - mesh_.vertices[v]);
      low = std::min(low, l), high = std::max(high, l);
    }
    return std::max(0., high / (limit_ * low) - 1);
  }

  // By the sizes at its ends, between which they are linear (RR-2818 sec. 5.2).
  [[nodiscard]] double metric_length(std::int32_t a, std::int32_t b) const {
    const double p = size_[a], q = size_[b], d = norm(mesh_.vertices[b] - mesh_.vertices[a]);
    return std::abs(q - p) > 1e-6 * p ? d * std::log(q / p) / (q - p) : d / p;
  }

  // `least`: edges are too short below.
  [[nodiscard]] Judgement judge(std::span<const std::int32_t> vertices, double least = shortest) const {
    Judgement sum;
    for (const std::int32_t v : vertices) {
      sum.excess += excess(v);
      for (const std::int32_t w : local_->ring(v)) {
        const double l = metric_length(v, w);
        sum.out += l < least || l > longest ? 1 : 0;
      }
      for (const Place p : local_->fan(v)) {
        const auto& t = local_->at(p);
        const auto corner = [&](int i) { return local_->position(p.face, t[i]); };
        sum.quality = std::min(sum.quality, quality_q2(corner(0), corner(1), corner(2)));
      }
    }
    return sum;
  }

  [[nodiscard]] bool agree(std::span<const Place> places, Vec3 mean) const {
    return std::all_of(places.begin(), places.end(), [&](Place p) {
      const Vec3 n = local_->normal(p);
      return dot(n, mean) > least_agreement * norm(n);
    });
  }

  // Faces between sides that were matched have no space, and stay.
  [[nodiscard]] bool has_space(std::int32_t face) const { return result_.spaces[face].has_value(); }

  [[nodiscard]] State state(Vertex v) const {
    const std::int32_t k = local_->global(v);
    return {mesh_.faces[v.face].uv[v.local], mesh_.vertices[k], size_[k]};
  }
  void set(Vertex v, const State& to) {
    const std::int32_t k = local_->global(v);
    mesh_.faces[v.face].uv[v.local] = to.uv, mesh_.vertices[k] = to.xyz, size_[k] = to.size;
  }
  void lift(Vertex v) {
    const Vec2 uv = mesh_.faces[v.face].uv[v.local];
    const SurfaceJet jet = surface_at(cad_, mesh_.faces[v.face].ref, want_position | want_first, uv);
    --left_;
    const double h = isotropic_size(jet, result_.spaces[v.face]->at(uv));
    set(v, {uv, jet.s, h > 0 ? h : size_[local_->global(v)]});
  }

  [[nodiscard]] Vertices with_ring(std::int32_t v) const {
    Vertices around = local_->ring(v);
    around.push_back(v);
    return around;
  }

  /// The best place of those tried for a vertex inside, by the judgement of it and its neighbours, which `best`
  /// becomes. None: where it is.
  std::optional<State> best_place(Vertex v, Judgement& best) {
    const Vertices around = with_ring(local_->global(v));
    const std::vector<Place>& fan = local_->fan(local_->global(v));
    const State here = state(v);
    const Vec3 mean = local_->mean_normal(fan);
    const UnitCircle circle(result_.spaces[v.face]->at(here.uv));
    std::optional<State> found;
    const Judgement before = judge(around);
    best = before;
    for (const double step : placement_distances)
      for (const Vec2& d : six_directions) {
        mesh_.faces[v.face].uv[v.local] = here.uv + circle.vector(step * d);
        if (left_ > 0 && local_->are_positive(fan)) {  // so it is inside the domain
          lift(v);
          const Judgement now = judge(around);
          if (now.no_worse_than(before) && now.better_than(best) && agree(fan, mean)) best = now, found = state(v);
        }
        set(v, here);
      }
    return found;
  }

  // Of v and its neighbours the one that gains most.
  bool move_one(std::int32_t v) {
    double most = 0;
    Vertex which{};
    std::optional<State> where;
    for (const std::int32_t w : with_ring(v)) {
      const auto inside = local_->inside(w);
      if (!inside || !has_space(inside->face)) continue;
      const Judgement before = judge(with_ring(w));
      Judgement after;
      const auto found = best_place(*inside, after);
      if (!found || !after.improves(before) || before.excess - after.excess <= most) continue;
      most = before.excess - after.excess, which = *inside, where = found;
    }
    if (!where) return false;
    set(which, *where);
    changed_.push_back(which);
    return true;
  }

  /// Calls `use` for each edge of the triangles around v that may go.
  template <typename Use>
  void for_edges_near(std::int32_t v, const Use& use) {
    const std::vector<Place> places = local_->fan(v);
    for (const Place p : places)
      for (int i = 0; i < 3; ++i)
        if (const auto quad = local_->quad(p, i); quad && has_space(p.face)) use(*quad);
  }

  bool swap_one(std::int32_t v) {
    std::optional<Quad> found;
    Judgement best;
    for_edges_near(v, [&](const Quad& q) {
      const auto around = local_->corners(q);
      const Judgement before = judge(around);
      const Vec3 mean = local_->mean_normal(q.places());
      if (!local_->swap(q)) return;
      const Judgement after = judge(around);
      if (after.improves(before) && agree(q.places(), mean) && (!found || after.better_than(best)))
        found = q, best = after;
      local_->restore(q);
    });
    return found && local_->swap(*found);
  }

  std::optional<Vertex> divide(const Quad& q) {
    const auto [a, b, c, d] = local_->corners(q);
    const auto middle = local_->divide(q);
    if (middle) size_.push_back(0.5 * (size_[a] + size_[b]));
    return middle;
  }
  void unite(const Quad& q) {
    local_->unite(q);
    size_.pop_back();
  }

  // Between imposed vertices nothing else may help.
  bool divide_one(std::int32_t v) {
    std::optional<Quad> found;
    Judgement best;
    State where;
    for_edges_near(v, [&](const Quad& q) {
      const Judgement before = judge(local_->corners(q), shortest_divided);
      const Vec3 mean = local_->mean_normal(q.places());
      const auto middle = divide(q);
      if (!middle) return;
      lift(*middle);
      Judgement after;
      for (int k = 0; k < placements; ++k)
        if (const auto to = best_place(*middle, after)) set(*middle, *to);
      const std::int32_t m = local_->global(*middle);
      after = judge(with_ring(m), shortest_divided);
      if (after.improves(before) && agree(local_->fan(m), mean) && (!found || after.better_than(best)))
        found = q, best = after, where = state(*middle);
      unite(q);
    });
    if (!found) return false;
    const Vertex middle = divide(*found).value();
    set(middle, where);
    changed_.push_back(middle);
    return true;
  }

  // Of vertices that have moved, or are new.
  void ask_sizes() {
    std::sort(changed_.begin(), changed_.end());
    changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
    for (const Vertex v : changed_) {
      const FaceInterfaces& from = result_.interfaces[v.face];
      FaceMetric prescribed(v.face, rules_, from.plane, from.physical, monitor_, {.field = result_.graded.get()});
      const Vec2 uv = mesh_.faces[v.face].uv[v.local];
      const SurfaceJet jet = surface_at(cad_, mesh_.faces[v.face].ref, prescribed.wants(), uv);
      Metric2 metric;
      prescribed.at({&uv, 1}, {&jet, 1}, {&metric, 1});
      if (const double h = isotropic_size(jet, metric); h > 0) size_[local_->global(v)] = h;
    }
  }

  double limit_;
  const SizeRules& rules_;
  Cad& cad_;
  CompositeResult& result_;
  SurfaceMesh& mesh_;
  std::vector<double>& size_;
  Monitor& monitor_;
  std::optional<LocalMesh> local_;
  std::int64_t left_ = 0;  // points of surfaces that may be asked
  std::vector<Vertex> changed_;
};

}  // namespace

void even_out_lengths(double limit, const SizeRules& rules, Cad& cad, CompositeResult& result, Monitor& monitor) {
  LengthEvening(limit, rules, cad, result, monitor).run();
}

}  // namespace carreau
