// SPDX-License-Identifier: BSD-3-Clause
#include "surface/improve/adjacent_sizes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "cad/batches.h"
#include "metric/field_length.h"
#include "metric/metric3_algebra.h"
#include "surface/improve/assembled_search.h"
#include "surface/improve/corner_agreement.h"
#include "surface/improve/thresholds.h"
#include "surface/sample/face_metric.h"

namespace carreau {

namespace {

using namespace thresholds::chord_gradation;

/// What is known at a vertex of a face.
struct Corner {
  Vec3 su, sv;
  Metric2 metric;  ///< of the control space
  bool sound;      ///< not at a pole

  /// Of unit length; zero at a pole.
  [[nodiscard]] Vec3 normal() const {
    const Vec3 n = cross(su, sv);
    return sound ? (1 / norm(n)) * n : Vec3{0, 0, 0};
  }
  /// Size along a chord, in the tangent plane.
  [[nodiscard]] double size_along(const Vec3& chord) const {
    const Metric2 g = induced_metric(su, sv, 1);
    const double p = dot(chord, su), q = dot(chord, sv);
    const Vec2 e = (1 / determinant(g)) * Vec2{g.c * p - g.b * q, g.a * q - g.b * p};
    return std::sqrt(squared_length(g, e) / squared_length(metric, e));
  }
};

/// Lengths in the metric.
struct Range {
  double shortest, longest;
};
constexpr Range usual{thresholds::assembled::shortest, thresholds::assembled::longest};
constexpr Range at_last{shortest_at_last, longest_at_last};

/// Of some edges and triangles.
struct Judgement {
  double excess = 0;   ///< of logarithms over the limit's, as a share of it
  int out = 0;         ///< edges that are too long or too short
  double quality = 1;  ///< in the metric, of the worst triangle
  double beyond = 0;   ///< largest angle or offset of a triangle, as a share of what is kept

  [[nodiscard]] bool better_than(const Judgement& other) const noexcept {
    return excess != other.excess ? excess < other.excess : quality > other.quality;
  }
  [[nodiscard]] bool improves(const Judgement& before) const noexcept {
    const bool mended = excess == 0 && before.excess > 0;
    return (mended || excess < before.excess - least_gain) && out <= before.out &&
           quality >= std::min(before.quality, good) && beyond <= std::max(before.beyond, 1.);
  }
};

/// The criterion: sizes along the chords of edges, by the control spaces.
class ChordGradation {
 public:
  using Vertex = EditableMesh::Vertex;
  using Place = EditableMesh::Place;

  ChordGradation(double limit, const GeometricLimits& kept, const CompositeResult& result)
      : log_limit_(aim * std::log(limit)), keeps_(kept.any()), kept_(kept), result_(result), all_(result.mesh) {}

  void ask_tangents(Cad& cad, Monitor& monitor) {
    corners_.resize(all_.faces.size());
    for (std::size_t f = 0; f < all_.faces.size(); ++f) {
      if (!result_.spaces[f]) continue;
      const auto face = static_cast<std::int32_t>(f);
      corners_[f].reserve(all_.faces[f].uv.size());
      for_batches(cad, all_.faces[f].ref, want_first, all_.faces[f].uv, monitor,
                  [&](std::size_t, std::span<const Vec2> at, std::span<const SurfaceJet> jets) {
                    for (std::size_t k = 0; k < at.size(); ++k) corners_[f].push_back(corner(face, at[k], jets[k]));
                  });
    }
  }

  /// By how much the sizes at the ends of an edge differ beyond the limit; 0 at poles.
  [[nodiscard]] double excess(std::int32_t face, std::int32_t a, std::int32_t b) const {
    if (!corners_[face][a].sound || !corners_[face][b].sound) return 0;
    const Vec3 chord = position(face, b) - position(face, a);
    const double p = corners_[face][a].size_along(chord), q = corners_[face][b].size_along(chord);
    const double change = std::abs(std::log(p / q));
    // Lengths are seldom needed: of nearly all edges this is far more than they have.
    const double roughly = norm(chord) / std::max(p, q);
    if (!std::isfinite(change) || change <= 0.5 * log_limit_ * roughly) return 0;
    const double l = field_length([&](const Vec2& at) { return metric(face, at); }, uv(face, a), uv(face, b), finest);
    return std::max(0., change / (log_limit_ * l) - 1);
  }

  /// The ends of edges inside that are steep.
  [[nodiscard]] std::vector<std::int32_t> find_steep(Monitor& monitor) const {
    constexpr std::size_t between_checks = 1 << 12;
    std::vector<std::int32_t> steep;
    std::size_t done = 0;
    for (std::size_t f = 0; f < all_.faces.size(); ++f) {
      if (!result_.spaces[f]) continue;
      for (const auto& t : all_.faces[f].triangles) {
        if (++done % between_checks == 0) monitor.checkpoint();
        for (int i = 0; i < 3; ++i) {
          const std::int32_t a = t[i], b = t[i == 2 ? 0 : i + 1];
          if (a > b || !(excess(static_cast<std::int32_t>(f), a, b) > 0)) continue;
          for (const std::int32_t v : {a, b}) steep.push_back(all_.faces[f].vertex[v]);
        }
      }
    }
    std::sort(steep.begin(), steep.end());
    steep.erase(std::unique(steep.begin(), steep.end()), steep.end());
    return steep;
  }

  /// Edges out of it count.
  void set_range(Range range) { range_ = range; }
  void add_triangle(std::int32_t face, const EditableMesh::Triangle& t, Judgement& sum) const {
    sum.quality = std::min(sum.quality, quality(face, t));
    if (!keeps_) return;
    const std::array<Vec3, 3> at{position(face, t[0]), position(face, t[1]), position(face, t[2])};
    const std::array<Vec3, 3> normals{corners_[face][t[0]].normal(), corners_[face][t[1]].normal(),
                                      corners_[face][t[2]].normal()};
    sum.beyond = std::max(sum.beyond, kept_.share(at, normals));
  }
  void add_edge(std::int32_t face, std::int32_t a, std::int32_t b, Judgement& sum) const {
    sum.excess += excess(face, a, b);
    const double l = std::sqrt(squared_length_of(face, a, b));
    sum.out += l < range_.shortest || l > range_.longest ? 1 : 0;
  }

  [[nodiscard]] const Corner& known(Vertex v) const { return corners_[v.face][v.local]; }
  void set_known(Vertex v, const Corner& corner) { corners_[v.face][v.local] = corner; }
  void learn(Vertex v, const SurfaceJet& jet) { set_known(v, corner(v.face, uv(v.face, v.local), jet)); }

 private:
  [[nodiscard]] Vec2 uv(std::int32_t face, std::int32_t v) const { return all_.faces[face].uv[v]; }
  [[nodiscard]] Vec3 position(std::int32_t face, std::int32_t v) const {
    return all_.vertices[all_.faces[face].vertex[v]];
  }
  [[nodiscard]] Metric2 metric(std::int32_t face, const Vec2& at) const { return result_.spaces[face]->at(at); }
  [[nodiscard]] Corner corner(std::int32_t face, const Vec2& at, const SurfaceJet& jet) const {
    return {jet.su, jet.sv, metric(face, at), TangentFrame::of(jet.su, jet.sv).has_value()};
  }
  [[nodiscard]] double squared_length_of(std::int32_t face, std::int32_t a, std::int32_t b) const {
    const Vec2 p = uv(face, a), q = uv(face, b);
    return squared_length(metric(face, 0.5 * (p + q)), q - p);
  }
  // HDR eq. 1.6 in the metric of the centre.
  [[nodiscard]] double quality(std::int32_t face, const EditableMesh::Triangle& t) const {
    double squares = 0;
    for (int i = 0; i < 3; ++i) squares += squared_length_of(face, t[i], t[(i + 1) % 3]);
    const Vec2 a = uv(face, t[0]), b = uv(face, t[1]), c = uv(face, t[2]);
    const double det = determinant(metric(face, (1. / 3) * (a + b + c)));
    return 2 * std::numbers::sqrt3 * cross(b - a, c - a) * std::sqrt(std::max(det, 0.)) / squares;
  }

  double log_limit_;
  bool keeps_;
  KeptAgreement kept_;
  const CompositeResult& result_;
  const SurfaceMesh& all_;
  std::vector<std::vector<Corner>> corners_;  // [face][its vertex]; none where nothing was sampled
  Range range_ = usual;
};

class SizeEvening {
 public:
  SizeEvening(ChordGradation& gradation, std::span<const std::int32_t> steep, const SizeRules& rules, Cad& cad,
              CompositeResult& result, Monitor& monitor)
      : search_(steep, rules, cad, result), mesh_(search_.mesh()), gradation_(gradation), monitor_(monitor) {}

  void run(std::vector<std::int32_t> steep) {
    for (const Range range : {usual, at_last}) {
      gradation_.set_range(range);
      steep = mend(std::move(steep));
    }
    search_.update_sizes(geometric_mean_size, monitor_);
  }

 private:
  using Place = EditableMesh::Place;
  using Quad = EditableMesh::Quad;

  // Around these vertices; returns those where nothing helps.
  std::vector<std::int32_t> mend(std::vector<std::int32_t> steep) {
    return improve_ring_by_ring(
        std::move(steep), {.ascending = true, .most = most_rings}, search_.budget(), monitor_,
        [this](std::int32_t v) { return is_steep(v); }, [this](std::int32_t v) { return move(v) || swap_one(v); },
        [this](std::int32_t v) { return search_.left_around(v); });
  }

  [[nodiscard]] bool is_steep(std::int32_t v) const {
    return std::ranges::any_of(mesh_.fan(v), [&](Place p) {
      const auto& t = mesh_.at(p);
      const int i = mesh_.rank_in(p, v);
      return search_.is_sampled(p.face) && (gradation_.excess(p.face, t[i], t[(i + 1) % 3]) > 0 ||
                                            gradation_.excess(p.face, t[(i + 2) % 3], t[i]) > 0);
    });
  }

  // Of a vertex inside.
  [[nodiscard]] Judgement around(std::int32_t v) const {
    Judgement sum;
    for (const Place p : mesh_.fan(v)) {
      const auto& t = mesh_.at(p);
      const int i = mesh_.rank_in(p, v);
      gradation_.add_edge(p.face, t[i], t[(i + 1) % 3], sum);
      gradation_.add_triangle(p.face, t, sum);
    }
    return sum;
  }

  // To the best of the places around it.
  bool move(std::int32_t v) {
    const auto inside = mesh_.inside(v);
    if (!inside || !search_.is_sampled(inside->face)) return false;
    Judgement best;
    const auto accepts = [](const Judgement& now, const Judgement& before) { return now.improves(before); };
    const auto found = search_.best_place(
        gradation_, *inside, [&] { return around(v); }, accepts, best);
    if (!found) return false;
    mesh_.move(*inside, found->uv, found->xyz);
    gradation_.set_known(*inside, found->known);
    search_.note_changed(*inside);
    return true;
  }

  [[nodiscard]] Judgement of_quad(const Quad& q, std::int32_t a, std::int32_t b) const {
    Judgement sum;
    gradation_.add_edge(q.face, a, b, sum);
    for (const Place p : q.places()) gradation_.add_triangle(p.face, mesh_.at(p), sum);
    return sum;
  }
  // The first steep edge at v that may be.
  bool swap_one(std::int32_t v) {
    const std::vector<Place> fan = mesh_.fan(v);
    for (const Place p : fan) {
      if (!search_.is_sampled(p.face)) continue;
      const int i = mesh_.rank_in(p, v);
      for (const int side : {i, (i + 2) % 3}) {
        const auto q = mesh_.quad(p, side);
        if (!q || !(gradation_.excess(q->face, q->a, q->b) > 0)) continue;
        Judgement after;
        if (search_.swap_if_better(
                *q, of_quad(*q, q->a, q->b), [&] { return of_quad(*q, q->c, q->d); }, after))
          return true;
      }
    }
    return false;
  }

  AssembledSearch search_;
  EditableMesh& mesh_;
  ChordGradation& gradation_;
  Monitor& monitor_;
};

}  // namespace

void even_out_sizes(double limit, const GeometricLimits& kept, const SizeRules& rules, Cad& cad,
                    CompositeResult& result, Monitor& monitor) {
  ChordGradation gradation(limit, kept, result);
  gradation.ask_tangents(cad, monitor);
  const std::vector<std::int32_t> steep = gradation.find_steep(monitor);
  if (!steep.empty()) SizeEvening(gradation, steep, rules, cad, result, monitor).run(steep);
}

}  // namespace carreau
