// SPDX-License-Identifier: BSD-3-Clause
// Ratios of the lengths of edges at a vertex. Private to even_edges.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "cad/batches.h"
#include "cad/fundamental_forms.h"
#include "mesh/quality.h"
#include "mesh/shape_levels.h"
#include "support/infinity.h"
#include "support/rounding_of.h"
#include "surface/improve/assembled_search.h"
#include "surface/improve/corner_agreement.h"
#include "surface/improve/evening.h"
#include "surface/sample/face_metric.h"

namespace carreau {

/// The criterion for sizes that are the same in all directions: each vertex has a size.
class LengthRatio {
 public:
  struct Known {
    double size;
    Vec3 normal;
  };
  static constexpr double good = shape_level::fair;
  static constexpr Rings rings{};
  static constexpr bool divides = true;
  static constexpr auto size_of = isotropic_size;

  LengthRatio(double limit, const GeometricLimits& kept, CompositeResult& result, Cad& cad, Monitor& monitor)
      : limit_((1 - rounding_of::places) * limit),
        keeps_(kept.any()),
        kept_(kept),
        all_(result.mesh),
        size_(result.vertex_size),
        normals_(result.mesh.faces.size()) {
    if (!keeps_) return;
    for (std::size_t f = 0; f < all_.faces.size(); ++f)
      if (result.spaces[f])
        for_batches(cad, all_.faces[f].ref, want_first, all_.faces[f].uv, monitor,
                    [&](std::size_t, std::span<const Vec2>, std::span<const SurfaceJet> jets) {
                      for (const SurfaceJet& jet : jets) normals_[f].push_back(normal_of(jet));
                    });
  }

  /// Finds vertices whose edges differ too much, over all faces; compares edges by their squares.
  [[nodiscard]] std::vector<std::int32_t> find_uneven(Monitor& monitor) const {
    std::vector<double> low(all_.vertices.size(), infinity), high(low.size(), 0);
    for (const FaceMesh& face : all_.faces) {
      monitor.checkpoint();
      for (const auto& t : face.triangles)
        for (int i = 0; i < 3; ++i) {
          const std::int32_t a = face.vertex[t[i]], b = face.vertex[t[i == 2 ? 0 : i + 1]];
          const Vec3 e = all_.vertices[b] - all_.vertices[a];
          const double l2 = dot(e, e);
          low[a] = std::min(low[a], l2), low[b] = std::min(low[b], l2);
          high[a] = std::max(high[a], l2), high[b] = std::max(high[b], l2);
        }
    }
    std::vector<std::int32_t> uneven;
    for (std::size_t v = 0; v < low.size(); ++v)
      if (high[v] > limit_ * limit_ * low[v]) uneven.push_back(static_cast<std::int32_t>(v));
    return uneven;
  }
  [[nodiscard]] bool is_uneven(const AssembledSearch& search, std::int32_t v) const {
    return excess(search.mesh(), v) > 0;
  }

  /// Judges vertices, their edges and the triangles around them.
  [[nodiscard]] EveningJudgement judge(const EditableMesh& mesh, std::span<const std::int32_t> vertices,
                                       LengthRange range) const {
    EveningJudgement sum;
    for (const std::int32_t v : vertices) {
      sum.excess += excess(mesh, v);
      for (const std::int32_t w : mesh.ring(v)) sum.out += range.excludes(metric_length(v, w)) ? 1 : 0;
      for (const EditableMesh::Place p : mesh.fan(v)) {
        const auto& t = mesh.at(p);
        const auto corner = [&](int i) { return mesh.position(p.face, t[i]); };
        sum.add(quality_q2(corner(0), corner(1), corner(2)));
        if (const auto& normal = normals_[p.face]; !normal.empty())
          sum.share = std::max(sum.share, kept_.share({corner(0), corner(1), corner(2)}, {normal[t[0]], normal[t[1]], normal[t[2]]}));
      }
    }
    return sum;
  }
  [[nodiscard]] EveningJudgement judge_around(const EditableMesh& mesh, std::int32_t v, LengthRange range) const {
    return judge(mesh, mesh.with_ring(v), range);
  }
  [[nodiscard]] EveningJudgement judge_quad(const EditableMesh& mesh, const EditableMesh::Quad& q, bool /*swapped*/,
                                            LengthRange range) const {
    return judge(mesh, mesh.corners(q), range);
  }

  /// The lengths at a vertex change with its neighbours, too.
  static std::vector<std::int32_t> movable_at(const EditableMesh& mesh, std::int32_t v) { return mesh.with_ring(v); }

  [[nodiscard]] Known known(const EditableMesh& mesh, EditableMesh::Vertex v) const {
    return {size_[mesh.global(v)], normals_[v.face].empty() ? Vec3{} : normals_[v.face][v.local]};
  }
  void set_known(const EditableMesh& mesh, EditableMesh::Vertex v, const Known& known) {
    size_[mesh.global(v)] = known.size;
    set_normal(v, known.normal);
  }
  void learn(const AssembledSearch& search, EditableMesh::Vertex v, const SurfaceJet& jet) {
    const double h = isotropic_size(jet, search.metric(v.face, search.mesh().uv(v)));
    if (h > 0) size_[search.mesh().global(v)] = h;
    if (keeps_) set_normal(v, normal_of(jet));
  }
  /// Appends a vertex between two others, with their mean size.
  void add_between(std::int32_t a, std::int32_t b) { size_.push_back(0.5 * (size_[a] + size_[b])); }
  void remove_last() { size_.pop_back(); }

 private:
  [[nodiscard]] static Vec3 normal_of(const SurfaceJet& jet) { return unit_normal(jet).value_or(Vec3{}); }
  // A vertex that divides an edge comes last.
  void set_normal(EditableMesh::Vertex v, const Vec3& normal) {
    auto& normals = normals_[v.face];
    if (normals.empty()) return;
    if (normals.size() <= static_cast<std::size_t>(v.local)) normals.resize(static_cast<std::size_t>(v.local) + 1);
    normals[v.local] = normal;
  }
  [[nodiscard]] double excess(const EditableMesh& mesh, std::int32_t v) const {
    double low = infinity, high = 0;
    for (const std::int32_t w : mesh.ring(v)) {
      const double l = norm(all_.vertices[w] - all_.vertices[v]);
      low = std::min(low, l), high = std::max(high, l);
    }
    return std::max(0., high / (limit_ * low) - 1);
  }
  // Length by the sizes at the ends of the edge, between which sizes are linear (RR-2818 sec. 5.2).
  [[nodiscard]] double metric_length(std::int32_t a, std::int32_t b) const {
    const double p = size_[a], q = size_[b], d = norm(all_.vertices[b] - all_.vertices[a]);
    return std::abs(q - p) > 1e-6 * p ? d * std::log(q / p) / (q - p) : d / p;
  }

  double limit_;
  bool keeps_;
  KeptAgreement kept_;
  const SurfaceMesh& all_;
  std::vector<double>& size_;
  std::vector<std::vector<Vec3>> normals_;  // [face][its vertex]; none if nothing is kept or sampled
};

}  // namespace carreau
