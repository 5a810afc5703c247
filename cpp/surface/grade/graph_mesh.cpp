// SPDX-License-Identifier: BSD-3-Clause
// The mesh of a face in the graph, and what the host says while its control space is sampled.
#include "plane/plane_mesher.h"
#include "support/infinity.h"
#include "surface/grade/grading_work.h"
#include "surface/lift/lift.h"
#include "surface/lift/steep_places.h"
#include "surface/sample/face_metric.h"
#include "surface/sample/thresholds.h"

namespace carreau::detail {

namespace {

void keep_sample(const GradingWork& work, Vec2 uv, const SurfaceJet& jet, Metric2 metric,
                 std::vector<GradingWork::Sample>& samples) {
  if (!work.by_direction) {
    if (const double h = isotropic_size(jet, metric); h > 0) samples.push_back({uv, jet.s, h});
  } else if (const auto sizes = tangent_metric(jet, metric)) {
    samples.push_back({uv, jet.s, 0, *sizes});
  }
}

// The graph's own control space; what the host says meanwhile is kept.
ControlSpace sample(GradingWork& work, const PatchInput& input, std::span<const Vec2> probe_points) {
  FaceMetric prescribed = unlimited_prescription_of(input, work.rules, work.monitor);
  std::vector<GradingWork::Sample>& samples = work.samples[input.face];
  std::vector<SurfaceJet> jets;
  SpeedWatch speeds(work.rules.asks_sources() ? infinity : thresholds::sample::uneven_speed, 0);
  const MetricSampler sampler = [&](std::span<const Vec2> uv, std::span<Metric2> metric) {
    jets.resize(uv.size());
    work.model.cad.surface(input.ref, want_position | prescribed.wants(), uv, jets);
    speeds.look(uv, jets);
    prescribed.at(uv, jets, metric);
    for (std::size_t i = 0; i < uv.size(); ++i) keep_sample(work, uv[i], jets[i], metric[i], samples);
    if (work.by_direction)
      apply_metric_limits(input.limits, input.face, uv, jets, metric);
    else
      apply_limits(input.limits, input.face, uv, jets, metric);
  };
  ControlSpaceOptions options;
  options.tolerance = input.tolerance;
  options.thorough = true;
  options.probe_points = probe_points;
  return ControlSpace::build(sampled_domain(input.domain->plane), sampler, options, work.monitor);
}

}  // namespace

// Where fields are known to be steep they are looked at, as in the mesh to come: sizes would grow from there within the
// face only.
PlaneMesh mesh_in_graph(GradingWork& work, const PatchInput& input) {
  const PlaneMesherOptions how{.frontal = work.options.frontal, .max_triangles = work.options.max_triangles};
  const PlaneDomain& domain = input.domain->plane;
  std::vector<Vec2> probe_points = work.rules.steep_places(input.face);
  std::vector<Vec2>& known = work.missed[input.face];
  probe_points.insert(probe_points.end(), known.begin(), known.end());
  ControlSpace space = sample(work, input, probe_points);
  PatchMesh mesh;
  mesh.plane = mesh_plane(domain, space, how, work.monitor);
  if (work.rules.steep_in_space().empty()) return std::move(mesh.plane);
  lift_patch(input, work.model.cad, mesh, work.monitor);
  const std::vector<Vec2> missed = missed_steep_places(input, space, work.model.cad, work.rules, mesh, work.monitor);
  if (missed.empty()) return std::move(mesh.plane);
  known.insert(known.end(), missed.begin(), missed.end());
  probe_points.insert(probe_points.end(), missed.begin(), missed.end());
  work.samples[input.face].clear();
  space = sample(work, input, probe_points);
  return mesh_plane(domain, space, how, work.monitor);
}

}  // namespace carreau::detail
