// SPDX-License-Identifier: BSD-3-Clause
// Gradation of sizes along the chords of edges. Private to even_edges.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "cad/batches.h"
#include "mesh/shape_levels.h"
#include "metric/field_length.h"
#include "metric/metric3_algebra.h"
#include "metric/unit_edge.h"
#include "support/shares.h"
#include "support/work_bounds.h"
#include "surface/improve/assembled_search.h"
#include "surface/improve/corner_agreement.h"
#include "surface/improve/evening.h"
#include "surface/sample/face_metric.h"

namespace carreau {

/// Tangents and metric at a vertex of a face.
struct ChordCorner {
  Vec3 su, sv;
  Metric2 metric;  ///< of the control space
  bool sound;      ///< not at a pole

  /// The normal of unit length; zero at a pole.
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

/// The criterion for sizes that differ by direction: each vertex of a face has tangents and a metric.
class ChordGradation {
 public:
  using Known = ChordCorner;
  using Vertex = EditableMesh::Vertex;
  using Place = EditableMesh::Place;
  static constexpr double good = shape_level::bad;
  static constexpr Rings rings{.ascending = true, .most = work_bounds::passes};
  static constexpr bool divides = false;
  static constexpr auto size_of = geometric_mean_size;

  ChordGradation(double limit, const GeometricLimits& kept, const CompositeResult& result, Cad& cad, Monitor& monitor)
      : log_limit_((1 - shares::negligible) * std::log(limit)),
        keeps_(kept.any()),
        kept_(kept),
        result_(result),
        all_(result.mesh) {
    ask_tangents(cad, monitor);
  }

  /// Finds the ends of steep edges inside faces.
  [[nodiscard]] std::vector<std::int32_t> find_uneven(Monitor& monitor) const {
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

  [[nodiscard]] bool is_uneven(const AssembledSearch& search, std::int32_t v) const {
    return std::ranges::any_of(search.mesh().fan(v), [&](Place p) {
      const auto& t = search.mesh().at(p);
      const int i = search.mesh().rank_in(p, v);
      return search.is_sampled(p.face) &&
             (excess(p.face, t[i], t[(i + 1) % 3]) > 0 || excess(p.face, t[(i + 2) % 3], t[i]) > 0);
    });
  }

  /// Judges the edges and triangles at a vertex inside a face.
  [[nodiscard]] EveningJudgement judge_around(const EditableMesh& mesh, std::int32_t v, LengthRange range) const {
    EveningJudgement sum;
    for (const Place p : mesh.fan(v)) {
      const auto& t = mesh.at(p);
      const int i = mesh.rank_in(p, v);
      add_edge(p.face, t[i], t[(i + 1) % 3], range, sum);
      add_triangle(p.face, t, sum);
    }
    return sum;
  }
  /// Judges the diagonal and both triangles.
  [[nodiscard]] EveningJudgement judge_quad(const EditableMesh& mesh, const EditableMesh::Quad& q, bool swapped,
                                            LengthRange range) const {
    EveningJudgement sum;
    add_edge(q.face, swapped ? q.c : q.a, swapped ? q.d : q.b, range, sum);
    for (const Place p : q.places()) add_triangle(p.face, mesh.at(p), sum);
    return sum;
  }

  /// Both ends of a steep edge are uneven.
  static std::array<std::int32_t, 1> movable_at(const EditableMesh& /*mesh*/, std::int32_t v) { return {v}; }

  [[nodiscard]] const ChordCorner& known(const EditableMesh& /*mesh*/, Vertex v) const {
    return corners_[v.face][v.local];
  }
  void set_known(const EditableMesh& /*mesh*/, Vertex v, const ChordCorner& corner) { corners_[v.face][v.local] = corner; }
  void learn(const AssembledSearch& /*search*/, Vertex v, const SurfaceJet& jet) {
    corners_[v.face][v.local] = corner(v.face, uv(v.face, v.local), jet);
  }

 private:
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

  /// The amount by which the sizes at the ends of an edge differ beyond the limit; 0 at poles.
  [[nodiscard]] double excess(std::int32_t face, std::int32_t a, std::int32_t b) const {
    if (!corners_[face][a].sound || !corners_[face][b].sound) return 0;
    const Vec3 chord = position(face, b) - position(face, a);
    const double p = corners_[face][a].size_along(chord), q = corners_[face][b].size_along(chord);
    const double change = std::abs(std::log(p / q));
    // Factor that avoids lengths: nearly all edges are far below.
    const double roughly = norm(chord) / std::max(p, q);
    if (!std::isfinite(change) || change <= 0.5 * log_limit_ * roughly) return 0;
    const double l = field_length([&](const Vec2& at) { return metric(face, at); }, uv(face, a), uv(face, b),
                                  unit_edge::finest);
    return std::max(0., change / (log_limit_ * l) - 1);
  }

  void add_triangle(std::int32_t face, const EditableMesh::Triangle& t, EveningJudgement& sum) const {
    sum.add(quality(face, t));
    if (!keeps_) return;
    const std::array<Vec3, 3> at{position(face, t[0]), position(face, t[1]), position(face, t[2])};
    const std::array<Vec3, 3> normals{corners_[face][t[0]].normal(), corners_[face][t[1]].normal(),
                                      corners_[face][t[2]].normal()};
    sum.share = std::max(sum.share, kept_.share(at, normals));
  }
  void add_edge(std::int32_t face, std::int32_t a, std::int32_t b, LengthRange range, EveningJudgement& sum) const {
    sum.excess += excess(face, a, b);
    sum.out += range.excludes(std::sqrt(squared_length_of(face, a, b))) ? 1 : 0;
  }
  [[nodiscard]] Vec2 uv(std::int32_t face, std::int32_t v) const { return all_.faces[face].uv[v]; }
  [[nodiscard]] Vec3 position(std::int32_t face, std::int32_t v) const {
    return all_.vertices[all_.faces[face].vertex[v]];
  }
  [[nodiscard]] Metric2 metric(std::int32_t face, const Vec2& at) const { return result_.spaces[face]->at(at); }
  [[nodiscard]] ChordCorner corner(std::int32_t face, const Vec2& at, const SurfaceJet& jet) const {
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
  std::vector<std::vector<ChordCorner>> corners_;  // [face][its vertex]; none where nothing was sampled
};

}  // namespace carreau
