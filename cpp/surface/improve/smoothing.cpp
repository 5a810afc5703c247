// SPDX-License-Identifier: BSD-3-Clause
#include "surface/improve/smoothing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "cad/fundamental_forms.h"
#include "mesh/editable_mesh.h"
#include "mesh/local_search.h"
#include "mesh/shape_levels.h"
#include "mesh/trial.h"
#include "support/angles.h"
#include "support/shares.h"
#include "surface/improve/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::smoothing;

// Shares of a step that are tested on the surface itself: it bends away from the tangent plane.
constexpr std::array<double, 3> shares{1, 0.5, 0.25};

class Smoothing {
 public:
  Smoothing(const BadRegion& region, const PlaneDomain& domain, int ref, Cad& cad, PatchMesh& mesh, Monitor& monitor)
      : region_(region),
        ref_(ref),
        cad_(cad),
        mesh_(mesh),
        monitor_(monitor),
        editable_(domain, mesh.plane, mesh.xyz, region.triangles()) {}

  std::vector<std::int32_t> run() {
    std::vector<std::int32_t> moved;
    constexpr int max_passes = 12;  // most patches need three
    improve_in_passes(
        max_passes, monitor_, [this] { return corners_of_bad(); },
        [&](std::int32_t v) {
          const bool better = improve(v);
          if (better) moved.push_back(v);
          return better;
        });
    return moved;
  }

 private:
  using Triangle = EditableMesh::Triangle;
  using Place = EditableMesh::Place;
  struct Known {
    bool tried = false;               // in vain, and nothing around has moved since
    std::optional<Vec3> normal = {};  // unit length, or zero where the surface has none; empty before its evaluation
  };

  /// The triangles around a vertex that may move.
  [[nodiscard]] const std::vector<Place>& star(std::int32_t v) const { return editable_.fan(v); }

  // Returns the vertices that may move, of the worst triangles first.
  [[nodiscard]] std::vector<std::int32_t> corners_of_bad() {
    std::vector<std::pair<double, std::int32_t>> bad;
    for (const std::int32_t t : region_.below(shape_level::good)) bad.emplace_back(quality_of(t), t);
    std::sort(bad.begin(), bad.end());
    std::vector<std::int32_t> corners;
    for (const auto& [quality, t] : bad)
      for (const std::int32_t v : mesh_.plane.triangles[t])
        if (region_.may_move(v) && !known_[v].tried) corners.push_back(v);
    return corners;
  }

  [[nodiscard]] double quality_of(std::int32_t t) const {
    return quality_in_space(mesh_.plane.triangles[t], mesh_.xyz);
  }
  [[nodiscard]] TriangleShapes shapes_around(std::int32_t v) const {
    TriangleShapes shapes;
    for (const Place p : star(v)) shapes.add(quality_of(p.triangle));
    return shapes;
  }
  // The quality, negative for a triangle that is turned against `normal`.
  [[nodiscard]] double signed_quality(std::int32_t t, const Vec3& normal) const {
    const double quality = quality_of(t);
    const auto& [a, b, c] = mesh_.plane.triangles[t];
    return dot(cross(mesh_.xyz[b] - mesh_.xyz[a], mesh_.xyz[c] - mesh_.xyz[a]), normal) < 0 ? -quality : quality;
  }
  // The worst signed quality of the triangles of order_. The triangle that decided last comes first. Below `least` the
  // exact value does not matter.
  [[nodiscard]] double worst_in_order(double least, const Vec3& normal) {
    double worst = 1;
    for (Place& p : order_) {
      worst = std::min(worst, signed_quality(p.triangle, normal));
      if (worst < least) {
        std::swap(p, order_.front());
        break;
      }
    }
    return worst;
  }
  [[nodiscard]] double mean_edge(std::int32_t v) const {
    double sum = 0;
    for (const Place p : star(v))
      for (const std::int32_t w : editable_.at(p)) sum += norm(mesh_.xyz[w] - mesh_.xyz[v]);
    return sum / (2 * static_cast<double>(star(v).size()));
  }

  [[nodiscard]] SurfaceJet jet_at(const Vec2& uv) { return surface_at(cad_, ref_, want_position | want_first, uv); }
  void ask_normals(std::int32_t centre) {
    std::vector<Vec2> uv;
    std::vector<std::int32_t> asked;
    for (const Place p : star(centre))
      for (const std::int32_t v : editable_.at(p))
        if (Known& known = known_[v]; !known.normal) {
          known.normal = Vec3{0, 0, 0};
          asked.push_back(v);
          uv.push_back(mesh_.plane.vertices[v]);
        }
    std::vector<SurfaceJet> jets(uv.size());
    if (!uv.empty()) cad_.surface(ref_, want_first, uv, jets);
    for (std::size_t k = 0; k < jets.size(); ++k) known_[asked[k]].normal = normal_of(jets[k]);
  }
  [[nodiscard]] static Vec3 normal_of(const SurfaceJet& jet) { return unit_normal(jet).value_or(Vec3{0, 0, 0}); }

  // The least cosine between a triangle's normal and the normals at its corners; a corner without a normal counts as
  // zero.
  [[nodiscard]] double agreement(Place p) {
    const Vec3 n = editable_.normal(p);
    const double size = norm(n);
    if (!(size > 0)) return -1;
    double least = 1;
    for (const std::int32_t v : editable_.at(p)) least = std::min(least, dot(n, *known_[v].normal) / size);
    return least;
  }

  // The way to the best place of the tangent plane, by a search along eight directions: the worst of some triangles
  // has no derivative. Beyond an edge of the star shapes would be as good, but turned.
  [[nodiscard]] Vec2 best_way(std::int32_t v, const Vec3& e1, const Vec3& e2) {
    const Vec3 home = mesh_.xyz[v];
    const double length = mean_edge(v);
    order_ = star(v);
    const Vec3 normal = cross(e1, e2);
    const Vec2 way = search_along_compass(worst_in_order(-1, normal), first_step * length, shares::small * length,
                                          [&](const Vec2& there, double best) {
                                            mesh_.xyz[v] = home + there.x() * e1 + there.y() * e2;
                                            return worst_in_order(best, normal);
                                          });
    mesh_.xyz[v] = home;
    return way;
  }

  bool improve(std::int32_t v) {
    if (known_[v].tried) return false;
    known_[v].tried = !move(v);
    if (known_[v].tried) return false;
    for (const Place p : star(v))
      for (const std::int32_t w : editable_.at(p)) known_[w].tried = false;
    return true;
  }

  bool move(std::int32_t v) {
    const TriangleShapes before = shapes_around(v);
    if (!(before.worst < shape_level::good)) return false;
    const Vec2 home = mesh_.plane.vertices[v];
    const SurfaceJet jet = jet_at(home);
    const std::optional<Vec3> normal = unit_normal(jet);
    if (!normal) return false;
    const Vec3 e1 = (1 / norm(jet.su)) * jet.su, e2 = cross(*normal, e1);
    const Vec2 way = best_way(v, e1, e2);
    if (way == Vec2{0, 0}) return false;
    const double along_v = way.y() / dot(jet.sv, e2);
    const Vec2 step{(way.x() - along_v * dot(jet.sv, e1)) / norm(jet.su), along_v};
    known_[v].normal = normal;
    ask_normals(v);
    agreement_before_.clear();
    for (const Place p : star(v)) agreement_before_.push_back(agreement(p));
    for (const double share : shares) {
      const Vec2 uv = home + share * step;
      if (!editable_.can_move({0, v}, uv)) continue;
      const SurfaceJet there = jet_at(uv);
      Trial trial(editable_);
      editable_.move({0, v}, uv, there.s);
      known_[v].normal = normal_of(there);
      const TriangleShapes after = shapes_around(v);
      const bool better = after.worst > before.worst + shape_level::gain && (before.worst < shape_level::poor || after.sum > before.sum);
      if (!better || !agrees(v)) continue;
      trial.accept();
      return true;
    }
    known_[v].normal = normal;
    return false;
  }

  [[nodiscard]] bool agrees(std::int32_t v) {
    const std::vector<Place>& around = star(v);
    for (std::size_t k = 0; k < around.size(); ++k)
      if (agreement(around[k]) < std::min(agreement_before_[k], angles::cosine_of_60)) return false;
    return true;
  }

  const BadRegion& region_;
  int ref_;
  Cad& cad_;
  PatchMesh& mesh_;
  Monitor& monitor_;
  EditableMesh editable_;
  std::unordered_map<std::int32_t, Known> known_;  // by vertex
  std::vector<Place> order_;                       // scratch of best_way()
  std::vector<double> agreement_before_;           // of the triangles of the star that is moved
};

}  // namespace

std::vector<std::int32_t> smooth_in_space(const BadRegion& region, const PlaneDomain& domain, int ref, Cad& cad,
                                          PatchMesh& mesh, Monitor& monitor) {
  return Smoothing(region, domain, ref, cad, mesh, monitor).run();
}

}  // namespace carreau
