// SPDX-License-Identifier: BSD-3-Clause
// The mesh of a face in the graph, and the samples of the host on it.
#include "support/error.h"
#include "support/ranks/triangle_packet.h"
#include "plane/plane_mesher.h"
#include "support/infinity.h"
#include "surface/grade/graph_sizes.h"
#include "surface/lift/lift.h"
#include "surface/lift/steep_places.h"
#include "surface/sample/face_metric.h"
#include "surface/sample/thresholds.h"

namespace carreau::detail {

namespace {

// Builds the graph's control space, and keeps the samples of the host.
ControlSpace sample(const GradingWork& work, const PatchInput& input, std::span<const Vec2> probe_points,
                    std::vector<GradingWork::Sample>& samples, Monitor& monitor) {
  samples.clear();
  FaceMetric prescribed = unlimited_prescription_of(input, work.rules, monitor);
  std::vector<SurfaceJet> jets;
  SpeedWatch speeds(work.rules.asks_sources() ? infinity : thresholds::sample::uneven_speed, 0);
  const MetricSampler sampler = [&](std::span<const Vec2> uv, std::span<Metric2> metric) {
    jets.resize(uv.size());
    work.model.cad.surface(input.ref, want_position | prescribed.wants(), uv, jets);
    speeds.look(uv, jets);
    prescribed.at(uv, jets, metric);
    for (std::size_t i = 0; i < uv.size(); ++i) work.sizes->keep_sample(uv[i], jets[i], metric[i], samples);
    apply_limits(input.limits, input.isotropic, input.face, uv, jets, metric);
  };
  ControlSpaceOptions options;
  options.tolerance = input.tolerance;
  options.thorough = true;
  options.probe_points = probe_points;
  return ControlSpace::build(sampled_domain(input.domain->plane), sampler, options, monitor);
}

// Samples the places where fields are known to be steep, as in the final mesh. Otherwise sizes would grow from there
// within the face only.
PlaneMesh mesh_in_graph(const GradingWork& work, const PatchInput& input, FaceInGraph& face, Monitor& monitor) {
  const PlaneMesherOptions how{.frontal = work.options.frontal, .max_triangles = work.options.max_triangles};
  const PlaneDomain& domain = input.domain->plane;
  std::vector<Vec2> probe_points = work.rules.steep_places(input.face);
  probe_points.insert(probe_points.end(), face.missed.begin(), face.missed.end());
  ControlSpace space = sample(work, input, probe_points, face.samples, monitor);
  PatchMesh mesh;
  mesh.plane = mesh_plane(domain, space, how, monitor);
  if (work.rules.steep_in_space().empty()) return std::move(mesh.plane);
  lift_patch(input, work.model.cad, mesh, monitor);
  const std::vector<Vec2> missed = missed_steep_places(input, space, work.model.cad, work.rules, mesh, monitor);
  if (missed.empty()) return std::move(mesh.plane);
  face.missed.insert(face.missed.end(), missed.begin(), missed.end());
  probe_points.insert(probe_points.end(), missed.begin(), missed.end());
  space = sample(work, input, probe_points, face.samples, monitor);
  return mesh_plane(domain, space, how, monitor);
}

// Positions, normals and prescribed sizes at the vertices.
void evaluate(const GradingWork& work, const PatchInput& input, FaceInGraph& face, Monitor& monitor) {
  FaceMetric prescribed = unlimited_prescription_of(input, work.rules, monitor);
  const std::vector<Vec2>& uv = face.mesh.vertices;
  const auto keep = [&](std::size_t v, const SurfaceJet& jet, Metric2 metric) {
    face.xyz.push_back(jet.s);
    face.normal.push_back(unit(cross(jet.su, jet.sv)));
    work.sizes->keep_vertex(prescribed, uv[v], jet, metric, face);
  };
  prescribed.sample(work.model.cad, input.ref, want_position, uv, keep);
}

void put(PacketWriter& packet, const TangentMetric& m) {
  for (int axis = 0; axis < 3; ++axis) packet.put(m.d1[axis]), packet.put(m.d2[axis]);
  packet.put(m.h1), packet.put(m.h2);
}

TangentMetric metric_of(PacketReader& packet) {
  TangentMetric m;
  for (int axis = 0; axis < 3; ++axis) m.d1[axis] = packet.real(), m.d2[axis] = packet.real();
  m.h1 = packet.real(), m.h2 = packet.real();
  return m;
}

constexpr std::size_t bytes_of_metric = 8 * sizeof(double), bytes_of_sample = 6 * sizeof(double) + bytes_of_metric;

}  // namespace

FaceInGraph face_in_graph(const GradingWork& work, const PatchInput& input, Monitor& monitor) {
  FaceInGraph face;
  face.missed = work.missed[input.face];
  try {
    face.mesh = mesh_in_graph(work, input, face, monitor);
    evaluate(work, input, face, monitor);
    return face;
  } catch (const DomainError&) {  // it fails again later, and is reported then
  } catch (const UnevenSpeed&) {  // sizes grow inside it by its own control space alone
  }
  FaceInGraph none;
  none.missed = std::move(face.missed);
  return none;
}

void FaceInGraph::put(PacketWriter& packet) const {
  packet.put(mesh.vertices);
  put_triangles(packet, mesh.triangles);
  packet.put(static_cast<std::int64_t>(samples.size()));
  for (const GradingWork::Sample& s : samples) {
    packet.put(s.uv);
    for (int axis = 0; axis < 3; ++axis) packet.put(s.xyz[axis]);
    packet.put(s.h), detail::put(packet, s.sizes);
  }
  packet.put(missed);
  packet.put(xyz), packet.put(normal), packet.put(h);
  packet.put(static_cast<std::int64_t>(metric.size()));
  for (const TangentMetric& m : metric) detail::put(packet, m);
}

FaceInGraph FaceInGraph::from(PacketReader& packet) {
  FaceInGraph face;
  face.mesh.vertices = packet.plane_points();
  face.mesh.triangles = triangles_of(packet);
  face.samples.resize(packet.count(bytes_of_sample));
  for (GradingWork::Sample& s : face.samples) {
    s.uv = packet.plane_point();
    for (int axis = 0; axis < 3; ++axis) s.xyz[axis] = packet.real();
    s.h = packet.real(), s.sizes = metric_of(packet);
  }
  face.missed = packet.plane_points();
  face.xyz = packet.points(), face.normal = packet.points(), face.h = packet.reals();
  face.metric.resize(packet.count(bytes_of_metric));
  for (TangentMetric& m : face.metric) m = metric_of(packet);
  return face;
}

}  // namespace carreau::detail
