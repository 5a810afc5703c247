#include "surface/improve/adjacent_sizes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "metric/field_length.h"
#include "metric/metric3_algebra.h"
#include "surface/improve/cubic_offset.h"
#include "surface/improve/local_mesh.h"
#include "surface/sample/face_metric.h"

namespace carreau {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// Edges are mended up to this share of the limit's logarithm: to be measured again, with other rounding.
constexpr double aim = 0.999;
// What a change that does not mend all must gain, in the sum of the excesses, so that changes come to an end.
constexpr double least_gain = 1e-3;
// Triangles of this quality in the metric are good whatever they were before.
constexpr double good_quality = 0.5;
/// Lengths in the metric.
struct Range {
  double shortest, longest;
};
// Of a unit mesh; of single edges where nothing else helps.
constexpr Range usual{std::numbers::sqrt2 / 2, std::numbers::sqrt2}, at_last{0.5, 1.6};
// Cosine of the angle between a new triangle and the mean of those that it replaces.
constexpr double least_agreement = 0.7;
// Lengths are summed up from pieces no longer than this.
constexpr double finest = 0.1;
// A change beside a vertex is judged by what is around its neighbours' neighbours; one beside these may follow.
constexpr int rings = 3;
constexpr int most_passes = 10;
constexpr std::size_t batch = 512, triangles_between_checks = 1 << 12;
// Points of surfaces that may be asked, whatever the mesh, and for each vertex of larger ones: a field that its own
// gradation does not reach has steep edges everywhere.
constexpr double least_budget = 5'000, budget_a_vertex = 0.25;

template <typename T>
void sort_uniquely(std::vector<T>& all) {
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
}

class SizeEvening {
 public:
  SizeEvening(double limit, const GeometricLimits& kept, const SizeRules& rules, Cad& cad, CompositeResult& result,
              Monitor& monitor)
      : log_limit_(aim * std::log(limit)),
        kept_(kept),
        sine_(std::isfinite(kept.edge_angle_deg) ? std::sin(kept.edge_angle_deg * std::numbers::pi / 180) : infinity),
        rules_(rules),
        cad_(cad),
        result_(result),
        mesh_(result.mesh),
        monitor_(monitor) {}

  void run() {
    ask_tangents();
    std::vector<std::int32_t> steep = find_steep();
    if (steep.empty()) return;
    local_.emplace(mesh_, steep, rings);
    left_ =
        static_cast<std::int64_t>(std::max(least_budget, budget_a_vertex * static_cast<double>(mesh_.vertices.size())));
    steep = mend(std::move(steep));
    range_ = at_last;
    mend(std::move(steep));
    ask_sizes();
  }

 private:
  using Vertex = LocalMesh::Vertex;
  using Place = LocalMesh::Place;
  using Quad = LocalMesh::Quad;
  /// What is known at a vertex of a face.
  struct Corner {
    Vec3 su, sv;
    Metric2 metric;  ///< of the control space
    bool sound;      ///< not at a pole
  };
  /// Of some edges and triangles.
  struct Judgement {
    double excess = 0;   ///< of logarithms over the limit's, as a share of it
    int out = 0;         ///< edges that are too long or too short
    double quality = 1;  ///< in the metric, of the worst triangle
    double beyond = 0;   ///< largest angle or offset of a triangle, as a share of what is kept

    [[nodiscard]] bool better_than(const Judgement& other) const noexcept {
      return excess != other.excess ? excess < other.excess : quality > other.quality;
    }
  };
  struct State {  ///< what moves change
    Vec2 uv;
    Vec3 xyz;
    Corner corner;
  };

  // Around these vertices; returns those where nothing helps.
  std::vector<std::int32_t> mend(std::vector<std::int32_t> steep) {
    std::vector<std::int32_t> left;
    for (int pass = 0; pass < most_passes && !steep.empty(); ++pass) {
      std::vector<std::int32_t> next;
      for (const std::int32_t v : steep) {
        monitor_.checkpoint();
        if (left_ <= 0 || !is_steep(v)) continue;
        if (!move(v) && !swap_one(v)) {
          left.push_back(v);
          continue;
        }
        // What is left of it, or has been left to others.
        for (const std::int32_t w : with_ring(v))
          if (local_->is_known(w)) next.push_back(w);
      }
      sort_uniquely(next);
      std::erase_if(next, [this](std::int32_t v) { return !is_steep(v); });
      steep.swap(next);
    }
    sort_uniquely(left);
    return left;
  }

  [[nodiscard]] bool has_space(std::size_t face) const { return result_.spaces[face].has_value(); }
  [[nodiscard]] Vec2 uv(std::int32_t face, std::int32_t v) const { return mesh_.faces[face].uv[v]; }
  [[nodiscard]] Metric2 metric(std::int32_t face, Vec2 at) const { return result_.spaces[face]->at(at); }

  void ask_tangents() {
    corners_.resize(mesh_.faces.size());
    std::vector<SurfaceJet> jets;
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      if (!has_space(f)) continue;
      const std::span<const Vec2> all = mesh_.faces[f].uv;
      corners_[f].reserve(all.size());
      for (std::size_t first = 0; first < all.size(); first += batch) {
        monitor_.checkpoint();
        const std::size_t n = std::min(batch, all.size() - first);
        jets.resize(n);
        cad_.surface(mesh_.faces[f].ref, want_first, all.subspan(first, n), jets);
        for (std::size_t k = 0; k < n; ++k)
          corners_[f].push_back(corner(static_cast<std::int32_t>(f), all[first + k], jets[k]));
      }
    }
  }

  [[nodiscard]] Corner corner(std::int32_t face, Vec2 at, const SurfaceJet& jet) const {
    return {jet.su, jet.sv, metric(face, at), TangentFrame::of(jet.su, jet.sv).has_value()};
  }

  // Size along a chord, in the tangent plane.
  [[nodiscard]] static double along(const Corner& c, Vec3 chord) noexcept {
    const Metric2 g = induced_metric(c.su, c.sv, 1);
    const double p = dot(chord, c.su), q = dot(chord, c.sv);
    const Vec2 e = (1 / determinant(g)) * Vec2{g.c * p - g.b * q, g.a * q - g.b * p};
    return std::sqrt(squared_length(g, e) / squared_length(c.metric, e));
  }

  /// By how much the sizes at the ends of an edge differ beyond the limit; 0 at poles.
  [[nodiscard]] double excess(std::int32_t face, std::int32_t a, std::int32_t b) const {
    if (!corners_[face][a].sound || !corners_[face][b].sound) return 0;
    const Vec3 chord = mesh_.vertices[mesh_.faces[face].vertex[b]] - mesh_.vertices[mesh_.faces[face].vertex[a]];
    const double p = along(corners_[face][a], chord), q = along(corners_[face][b], chord);
    const double change = std::abs(std::log(p / q));
    // Lengths are seldom needed: of nearly all edges this is far more than they have.
    const double roughly = norm(chord) / std::max(p, q);
    if (!std::isfinite(change) || change <= 0.5 * log_limit_ * roughly) return 0;
    const double l = field_length([&](Vec2 at) { return metric(face, at); }, uv(face, a), uv(face, b), finest);
    return std::max(0., change / (log_limit_ * l) - 1);
  }

  // The ends of edges inside.
  [[nodiscard]] std::vector<std::int32_t> find_steep() const {
    std::vector<std::int32_t> steep;
    std::size_t done = 0;
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      if (!has_space(f)) continue;
      for (const auto& t : mesh_.faces[f].triangles) {
        if (++done % triangles_between_checks == 0) monitor_.checkpoint();
        for (int i = 0; i < 3; ++i) {
          const std::int32_t a = t[i], b = t[i == 2 ? 0 : i + 1];
          if (a > b || !(excess(static_cast<std::int32_t>(f), a, b) > 0)) continue;
          for (const std::int32_t v : {a, b}) steep.push_back(mesh_.faces[f].vertex[v]);
        }
      }
    }
    sort_uniquely(steep);
    return steep;
  }

  [[nodiscard]] int rank_in(Place p, std::int32_t v) const {
    const auto& t = local_->at(p);
    return local_->global(p.face, t[0]) == v ? 0 : local_->global(p.face, t[1]) == v ? 1 : 2;
  }
  [[nodiscard]] bool is_steep(std::int32_t v) const {
    const std::vector<Place>& fan = local_->fan(v);
    return std::any_of(fan.begin(), fan.end(), [&](Place p) {
      const auto& t = local_->at(p);
      const int i = rank_in(p, v);
      return has_space(p.face) &&
             (excess(p.face, t[i], t[(i + 1) % 3]) > 0 || excess(p.face, t[(i + 2) % 3], t[i]) > 0);
    });
  }

  [[nodiscard]] double squared_length_of(std::int32_t face, std::int32_t a, std::int32_t b) const {
    const Vec2 p = uv(face, a), q = uv(face, b);
    return squared_length(metric(face, 0.5 * (p + q)), q - p);
  }
  // HDR eq. 1.6 in the metric of the centre.
  [[nodiscard]] double quality(Place p) const {
    const auto& t = local_->at(p);
    double squares = 0;
    for (int i = 0; i < 3; ++i) squares += squared_length_of(p.face, t[i], t[(i + 1) % 3]);
    const Vec2 a = uv(p.face, t[0]), b = uv(p.face, t[1]), c = uv(p.face, t[2]);
    const double det = determinant(metric(p.face, (1. / 3) * (a + b + c)));
    return 2 * std::numbers::sqrt3 * cross(b - a, c - a) * std::sqrt(std::max(det, 0.)) / squares;
  }
  // By what is known at its corners, as in space_refinement.
  [[nodiscard]] double beyond(Place p) const {
    const auto& t = local_->at(p);
    const auto normal = [&](std::int32_t v) {
      const Vec3 n = cross(corners_[p.face][v].su, corners_[p.face][v].sv);
      return corners_[p.face][v].sound ? (1 / norm(n)) * n : Vec3{};
    };
    double share = 0, middle = 0;
    for (int i = 0; i < 3; ++i) {
      const std::int32_t a = t[i], b = t[(i + 1) % 3];
      const Vec3 e = local_->position(p.face, b) - local_->position(p.face, a);
      const double from = dot(e, normal(a)), to = -dot(e, normal(b));
      share = std::max(share, std::max(std::abs(from), std::abs(to)) / (sine_ * norm(e)));
      for (const double s : along_edge) share = std::max(share, std::abs(cubic_offset(s, from, to)) / kept_.deviation);
      middle += from + to;
    }
    return std::max(share, std::abs(middle) / (18 * kept_.deviation));
  }
  void add_triangle(Place p, Judgement& sum) const {
    sum.quality = std::min(sum.quality, quality(p));
    if (kept_.any()) sum.beyond = std::max(sum.beyond, beyond(p));
  }
  void add_edge(std::int32_t face, std::int32_t a, std::int32_t b, Judgement& sum) const {
    sum.excess += excess(face, a, b);
    const double l = std::sqrt(squared_length_of(face, a, b));
    sum.out += l < range_.shortest || l > range_.longest ? 1 : 0;
  }
  // Of a vertex inside.
  [[nodiscard]] Judgement around(std::int32_t v) const {
    Judgement sum;
    for (const Place p : local_->fan(v)) {
      const auto& t = local_->at(p);
      const int i = rank_in(p, v);
      add_edge(p.face, t[i], t[(i + 1) % 3], sum);
      add_triangle(p, sum);
    }
    return sum;
  }
  [[nodiscard]] bool improves(const Judgement& now, const Judgement& before) const noexcept {
    const bool mended = now.excess == 0 && before.excess > 0;
    return (mended || now.excess < before.excess - least_gain) && now.out <= before.out &&
           now.quality >= std::min(before.quality, good_quality) && now.beyond <= std::max(before.beyond, 1.);
  }
  [[nodiscard]] bool agree(std::span<const Place> places, Vec3 mean) const {
    return std::all_of(places.begin(), places.end(), [&](Place p) {
      const Vec3 n = local_->normal(p);
      return dot(n, mean) > least_agreement * norm(n);
    });
  }

  [[nodiscard]] std::vector<std::int32_t> with_ring(std::int32_t v) const {
    std::vector<std::int32_t> all = local_->ring(v);
    all.push_back(v);
    return all;
  }
  [[nodiscard]] State state(Vertex v) const {
    return {uv(v.face, v.local), mesh_.vertices[local_->global(v)], corners_[v.face][v.local]};
  }
  void set(Vertex v, const State& to) {
    mesh_.faces[v.face].uv[v.local] = to.uv;
    mesh_.vertices[local_->global(v)] = to.xyz;
    corners_[v.face][v.local] = to.corner;
  }

  // To the best of the places around it.
  bool move(std::int32_t v) {
    const auto inside = local_->inside(v);
    if (!inside || !has_space(inside->face)) return false;
    const std::vector<Place>& fan = local_->fan(v);
    const State here = state(*inside);
    const Vec3 mean = local_->mean_normal(fan);
    const UnitCircle circle(here.corner.metric);
    const Judgement before = around(v);
    Judgement best = before;
    std::optional<State> found;
    for (const double step : placement_distances)
      for (const Vec2& d : six_directions) {
        const Vec2 at = here.uv + circle.vector(step * d);
        mesh_.faces[inside->face].uv[inside->local] = at;
        if (left_ > 0 && local_->are_positive(fan)) {  // so it is inside the domain
          const SurfaceJet jet = surface_at(cad_, mesh_.faces[inside->face].ref, want_position | want_first, at);
          --left_;
          set(*inside, {at, jet.s, corner(inside->face, at, jet)});
          const Judgement now = around(v);
          if (improves(now, before) && now.better_than(best) && agree(fan, mean)) best = now, found = state(*inside);
        }
        set(*inside, here);
      }
    if (!found) return false;
    set(*inside, *found);
    changed_.push_back(*inside);
    return true;
  }

  [[nodiscard]] Judgement of_quad(const Quad& q, std::int32_t a, std::int32_t b) const {
    Judgement sum;
    add_edge(q.face, a, b, sum);
    for (const Place p : q.places()) add_triangle(p, sum);
    return sum;
  }
  // The first steep edge at v that may be.
  bool swap_one(std::int32_t v) {
    const std::vector<Place> fan = local_->fan(v);
    for (const Place p : fan) {
      if (!has_space(p.face)) continue;
      const int i = rank_in(p, v);
      for (const int side : {i, (i + 2) % 3}) {
        const auto q = local_->quad(p, side);
        if (!q || !(excess(q->face, q->a, q->b) > 0)) continue;
        const Judgement before = of_quad(*q, q->a, q->b);
        const Vec3 mean = local_->mean_normal(q->places());
        if (!local_->swap(*q)) continue;
        if (improves(of_quad(*q, q->c, q->d), before) && agree(q->places(), mean)) return true;
        local_->restore(*q);
      }
    }
    return false;
  }

  // Of vertices that have moved.
  void ask_sizes() {
    sort_uniquely(changed_);
    for (const Vertex v : changed_) {
      const FaceInterfaces& from = result_.interfaces[v.face];
      FaceMetric prescribed(v.face, rules_, from.plane, from.physical, monitor_, {.field = result_.graded.get()});
      const Vec2 at = uv(v.face, v.local);
      const SurfaceJet jet = surface_at(cad_, mesh_.faces[v.face].ref, prescribed.wants(), at);
      Metric2 there;
      prescribed.at({&at, 1}, {&jet, 1}, {&there, 1});
      if (const double h = mean_size(jet, there); h > 0) result_.vertex_size[local_->global(v)] = h;
    }
  }

  double log_limit_;
  GeometricLimits kept_;
  double sine_;  // of the angle kept
  const SizeRules& rules_;
  Cad& cad_;
  CompositeResult& result_;
  SurfaceMesh& mesh_;
  Monitor& monitor_;
  std::vector<std::vector<Corner>> corners_;  // [face][its vertex]; none where nothing was sampled
  std::optional<LocalMesh> local_;
  std::int64_t left_ = 0;  // points of surfaces that may be asked
  Range range_ = usual;
  std::vector<Vertex> changed_;
};

}  // namespace

void even_out_sizes(double limit, const GeometricLimits& kept, const SizeRules& rules, Cad& cad,
                    CompositeResult& result, Monitor& monitor) {
  SizeEvening(limit, kept, rules, cad, result, monitor).run();
}

}  // namespace carreau
