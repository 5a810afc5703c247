// SPDX-License-Identifier: BSD-3-Clause
#include "measure/discrete_evaluation.h"

#include <algorithm>
#include <cstdio>

#include "cad/fundamental_forms.h"
#include "measure/composite_evaluation.h"
#include "mesh/distance/surface_distance.h"
#include "support/infinity.h"
#include "support/shares.h"
#include "surface/discrete/start_mesh.h"
#include "surface/remesh/base/charts.h"

namespace carreau {

namespace {

std::size_t index(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

/// Triangles of the atlas by the patch that they are of.
class PatchAtlas {
 public:
  PatchAtlas(const discrete::DiscreteCad& surface, const Charts& charts)
      : surface_(surface), charts_(charts), first_(surface.discrete().triangles() + 1, 0) {
    const auto n = static_cast<std::int32_t>(charts.triangles().size());
    std::vector<std::int32_t> patch(index(n));
    for (std::int32_t t = 0; t < n; ++t) ++first_[index(patch[index(t)] = surface.patch_of(middle(t))) + 1];
    for (std::size_t p = 1; p < first_.size(); ++p) first_[p] += first_[p - 1];
    of_.resize(index(n));
    std::vector<std::int32_t> fill(first_.begin(), first_.end() - 1);
    for (std::int32_t t = 0; t < n; ++t) of_[index(fill[index(patch[index(t)])]++)] = t;
  }

  /// The metric at a point of (u, v).
  [[nodiscard]] Metric2 metric(const Vec2& uv, const SurfaceJet& jet) const {
    const Foot foot = foot_at(uv);
    if (charts_.by_direction())
      if (const auto normal = unit_normal(jet))
        return induced_metric(jet.su, jet.sv, charts_.metric(foot, *normal).metric);
    return induced_metric(jet.su, jet.sv, charts_.size(foot));
  }

 private:
  [[nodiscard]] Foot foot_at(const Vec2& uv) const {
    const std::int32_t p = surface_.patch_of(uv);
    std::int32_t best = of_[index(first_[index(p)])];
    double most = -infinity;
    for (std::int32_t k = first_[index(p)]; k < first_[index(p) + 1]; ++k)
      if (const double inside = min_weight(of_[index(k)], uv); inside > most) most = inside, best = of_[index(k)];
    return {best, uv};
  }
  [[nodiscard]] Vec2 middle(std::int32_t t) const {
    return (charts_.uv(t, 0) + charts_.uv(t, 1) + charts_.uv(t, 2)) / 3;
  }
  [[nodiscard]] double min_weight(std::int32_t t, const Vec2& p) const {
    return std::ranges::min(charts_.weights(t, p));
  }

  const discrete::DiscreteCad& surface_;
  const Charts& charts_;
  std::vector<std::int32_t> first_, of_;
};

}  // namespace

MeshEvaluation evaluate_discrete(const discrete::DiscreteCad& surface, Cad& cad, const CompositeOptions& options,
                                 const CompositeResult& result, Monitor& monitor) {
  const PatchAtlas atlas(surface, *result.atlas);
  const PrescribedMetric metric{
      want_first, [&](int, std::span<const Vec2> uv, std::span<const SurfaceJet> jets, std::span<Metric2> out) {
        for (std::size_t k = 0; k < uv.size(); ++k) out[k] = atlas.metric(uv[k], jets[k]);
      }};
  EvaluationOptions measure = evaluation_options(options, result, angle_slack_of(options));
  measure.law = options.size.law;
  return evaluate_mesh(result.mesh, cad, metric, measure, monitor);
}

void bound_input_distances(const discrete::DiscreteSurface& surface, const SurfaceMesh& mesh, int threads,
                           Monitor& monitor, MeshEvaluation& delivered) {
  if (mesh.cells_are_not_triangles()) return;
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const FaceMesh& face : mesh.faces)
    for (const auto& t : face.triangles)
      triangles.push_back({face.vertex[index(t[0])], face.vertex[index(t[1])], face.vertex[index(t[2])]});
  const TrianglesOfSpace made{mesh.vertices, triangles}, given{surface.mesh().vertices, surface.mesh().triangles};
  const DistanceBounds there = bound_distance(made, given, {}, threads, monitor,
                                              &delivered[EvaluationKind::input_bound].values),
                       back = bound_distance(given, made, {}, threads, monitor);
  delivered.input = {there.lower, there.upper, back.lower, back.upper};
  summarise(delivered);
}

FarPlace farthest_by_size(const TrianglesOfSpace& made, std::span<const FarPoint> of_made,
                          std::span<const FarPoint> of_given) {
  FarPlace worst;
  const auto look = [&](const FarPoint& point, std::size_t triangle) {
    const auto& [a, b, c] = made.triangles[triangle];
    const Vec3 &p = made.vertices[index(a)], &q = made.vertices[index(b)], &r = made.vertices[index(c)];
    const double size = (norm(q - p) + norm(r - q) + norm(p - r)) / 3;
    if (point.distance * worst.size > worst.distance * size || worst.size == 0)
      worst = {point.at, point.distance, size};
  };
  for (std::size_t t = 0; t < of_made.size(); ++t) look(of_made[t], t);
  for (const FarPoint& point : of_given) look(point, index(point.nearest));
  return worst;
}

void warn_of_distance(const FarPlace& place, Monitor& monitor) {
  if (!(place.distance > shares::notable * place.size)) return;
  char text[160];
  std::snprintf(text, sizeof text, "the mesh is %.3g away from the triangles at (%.6g, %.6g, %.6g), %.2g of the size there",
                place.distance, place.at.x(), place.at.y(), place.at.z(), place.distance / place.size);
  monitor.message(Level::warning, std::string(text) + ": the size does not resolve the surface, or edges below the sharp angle are rounded");
}

}  // namespace carreau
