// SPDX-License-Identifier: BSD-3-Clause
#include "surface/lift/steep_places.h"

#include <algorithm>
#include <cmath>

#include "mesh/triangle_search.h"
#include "predicates/polygon_locator.h"
#include "support/infinity.h"
#include "support/rounding_of.h"
#include "support/shares.h"
#include "surface/lift/thresholds.h"
#include "surface/lift/verification.h"
#include "surface/sample/face_metric.h"

namespace carreau {
namespace {

using namespace thresholds::lift;

/// A place during its search on the surface.
struct Foot {
  Vec3 at;
  double reach;
  Vec2 uv;
  bool moving = true;
};

/// Gauss-Newton step towards the nearest point of the tangent plane; empty if the plane is degenerate.
Vec2 step_towards(const SurfaceJet& jet, const Vec3& at) noexcept {
  const Vec3 away = at - jet.s;
  const double e = dot(jet.su, jet.su), f = dot(jet.su, jet.sv), g = dot(jet.sv, jet.sv);
  const double p = dot(jet.su, away), q = dot(jet.sv, away), det = e * g - f * f;
  if (!(det > rounding_of::heights * e * g)) return {};
  return {(g * p - f * q) / det, (e * q - f * p) / det};
}

class SteepPlaces {
 public:
  SteepPlaces(const PatchInput& input, Cad& cad, const PatchMesh& mesh, Monitor& monitor)
      : input_(input), cad_(cad), mesh_(mesh), monitor_(monitor) {}

  // Finds places whose nearest point of the mesh may be the nearest point of the surface.
  std::vector<Foot> begin(const std::vector<SteepPlace>& places) {
    Vec3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
    double longest = 0;
    for (const Vec3& p : mesh_.xyz) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    for (const auto& t : mesh_.plane.triangles)
      for (int i = 0; i < 3; ++i) longest = std::max(longest, norm(mesh_.xyz[t[i]] - mesh_.xyz[t[(i + 1) % 3]]));
    const auto near_box = [&](const SteepPlace& s) {
      const double d = s.reach + longest;
      return s.at.x() > low.x() - d && s.at.x() < high.x() + d && s.at.y() > low.y() - d && s.at.y() < high.y() + d &&
             s.at.z() > low.z() - d && s.at.z() < high.z() + d;
    };
    std::vector<SteepPlace> around;
    std::copy_if(places.begin(), places.end(), std::back_inserter(around), near_box);
    if (around.empty()) return {};
    const TriangleSearch tree(mesh_.xyz, mesh_.plane.triangles, &monitor_);
    std::vector<Foot> feet;
    std::int32_t last = 0;
    for (const SteepPlace& s : around) {
      const NearestOnMesh n = tree.nearest(s.at, last);
      last = n.triangle;
      // A surface leaves its triangles by less than their edges.
      if (n.distance > s.reach + tree.longest_edge(n.triangle)) continue;
      const auto& t = mesh_.plane.triangles[static_cast<std::size_t>(n.triangle)];
      const std::vector<Vec2>& uv = mesh_.plane.vertices;
      feet.push_back({s.at, s.reach, n.weight[0] * uv[t[0]] + n.weight[1] * uv[t[1]] + n.weight[2] * uv[t[2]]});
    }
    return feet;
  }

  // The mesh lies within the domain but for chords of its curves: places beside them are left where they leave it.
  void project(std::vector<Foot>& feet) {
    const SampledDomain domain = sampled_domain(input_.domain->plane);
    const PolygonLocator locator(domain.vertices, domain.edges);
    std::erase_if(feet, [&](const Foot& f) { return !locator.contains(f.uv); });
    std::vector<double> distance(feet.size(), infinity);
    std::vector<std::size_t> moving;
    std::vector<Vec2> uv;
    const auto move = [&](std::size_t first, std::span<const Vec2>, std::span<const SurfaceJet> jets) {
      for (std::size_t i = 0; i < jets.size(); ++i) {
        Foot& f = feet[moving[first + i]];
        distance[moving[first + i]] = norm(f.at - jets[i].s);
        const Vec2 d = step_towards(jets[i], f.at);
        f.moving = norm(d.x() * jets[i].su + d.y() * jets[i].sv) > shares::negligible * f.reach && locator.contains(f.uv + d);
        if (f.moving) f.uv = f.uv + d;
      }
    };
    for (int step = 0; step < rounding_of::newton_steps; ++step) {
      moving.clear(), uv.clear();
      for (std::size_t k = 0; k < feet.size(); ++k)
        if (feet[k].moving) moving.push_back(k), uv.push_back(feet[k].uv);
      for_batches(cad_, input_.ref, want_position | want_first, uv, monitor_, move);
    }
    std::size_t kept = 0;
    for (std::size_t k = 0; k < feet.size(); ++k)
      if (distance[k] <= feet[k].reach) feet[kept++] = feet[k];
    feet.resize(kept);
  }

 private:
  const PatchInput& input_;
  Cad& cad_;
  const PatchMesh& mesh_;
  Monitor& monitor_;
};

}  // namespace

std::vector<Vec2> missed_steep_places(const PatchInput& input, const ControlSpace& space, Cad& cad,
                                      const SizeRules& rules, const PatchMesh& mesh, Monitor& monitor) {
  const std::vector<SteepPlace> places = rules.steep_in_space();
  if (places.empty() || mesh.plane.triangles.empty()) return {};
  SteepPlaces search(input, cad, mesh, monitor);
  std::vector<Foot> feet = search.begin(places);
  if (feet.empty()) return {};
  search.project(feet);
  FaceMetric prescribed = prescription_of(input, rules, monitor);
  std::vector<Vec2> missed, uv;
  for (const Foot& foot : feet) uv.push_back(foot.uv);
  prescribed.sample(cad, input.ref, 0, uv, [&](std::size_t k, const SurfaceJet&, Metric2 metric) {
    if (!agree(length_ratios(metric, space.at(uv[k])), input)) missed.push_back(uv[k]);
  });
  if (missed.size() <= max_places) return missed;
  std::vector<Vec2> some;
  for (std::size_t k = 0; k < max_places; ++k) some.push_back(missed[k * missed.size() / max_places]);
  return some;
}

}  // namespace carreau
