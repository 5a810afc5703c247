// SPDX-License-Identifier: BSD-3-Clause
#include "surface/independent/independent.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "support/infinity.h"
#include "surface/independent/placed_mesh.h"
#include "surface/independent/reassembly.h"
#include "surface/independent/remeshing.h"
#include "surface/independent/thresholds.h"
#include "surface/independent/tries.h"
#include "surface/independent/edits/worst_first.h"

namespace carreau {

namespace {

using namespace thresholds::independent;

// What the patches were meshed with, at their vertices; none where it is of no direction.
PlaneMetrics metrics_of(const CompositeResult& result, const VertexJets& jets) {
  PlaneMetrics metrics(result.mesh.faces.size());
  double most = 1;
  for (std::size_t f = 0; f < metrics.size(); ++f) {
    const FaceMesh& face = result.mesh.faces[f];
    for (std::size_t k = 0; k < face.uv.size() && k < jets[f].size(); ++k) {
      const double h = result.vertex_size[face.vertex[k]];
      metrics[f].push_back(result.spaces[f] ? plane_metric(jets[f][k], result.spaces[f]->at(face.uv[k]), h)
                                            : plane_metric(jets[f][k], induced_metric(jets[f][k].su, jets[f][k].sv, h), h));
      most = std::max(most, anisotropy(metrics[f].back()));
    }
  }
  return most > least_anisotropy ? metrics : PlaneMetrics{};
}

RemeshingFrame frame_of(const CurveModel& model, const CompositeOptions& options, bool by_direction,
                        const CompositeResult& result, Monitor& monitor) {
  const SurfaceMesh& mesh = result.mesh;
  RemeshingFrame frame{.jets = evaluate_vertices(mesh, model.cad, monitor), .sharp = {}, .charts = {}, .corners = {}, .lines = {}, .geometry = {}};
  const double angle = options.sharp_angle;
  frame.sharp = find_sharp_edges(mesh, frame.jets, angle);
  const PlaneMetrics metrics = by_direction ? metrics_of(result, frame.jets) : PlaneMetrics{};
  const auto link = [&] {
    frame.charts = std::make_shared<Charts>(mesh, frame.sharp, result.vertex_size, metrics, monitor);
  };
  link();
  if (const std::vector<MeshEdge> twisted = frame.charts->twisted(); !twisted.empty()) {
    frame.sharp.insert(frame.sharp.end(), twisted.begin(), twisted.end());
    std::ranges::sort(frame.sharp);
    link();
  }
  const Topology* known = mesh.curves.size() == model.topology.curves.size() ? &model.topology : nullptr;
  frame.corners = find_corners(mesh, frame.jets, *frame.charts, frame.sharp, known, model.supports, angle);
  frame.lines = find_lines(mesh, frame.sharp, frame.corners);
  return frame;
}

void give_makers(const CurveModel& model, std::span<const DiscreteCurve> curves, const ElementMaker& elements, const CompositeResult& result,
                 RemeshingFrame& frame) {
  if (elements) frame.elements = [&](const SurfaceMesh& before, FreedMesh& made) { elements(before, frame, made); };
  frame.geometry = [&, curves](const SharpLine& line) {
    return std::make_unique<LinePlaces>(line, result.mesh, model, curves, *frame.charts, model.cad);
  };
}

// The mesh that was made elsewhere: its seams are mended, and what is bad.
std::optional<StartedMesh> mended(Cad& cad, const SurfaceTolerances& tolerances, const CompositeResult& result, RemeshingFrame& frame,
                                  Monitor& monitor) {
  std::vector<WorkedLine> worked;
  for (const SharpLine& line : frame.lines) worked.emplace_back(line, frame.geometry(line));
  std::optional<PlacedMesh> placed = frame.made(worked, tolerances);
  if (!placed) return {};
  std::vector<MeshEdge> sharp;
  for (const std::vector<LineNode>& line : placed->lines)
    for (std::size_t k = 1; k < line.size(); ++k) sharp.push_back(mesh_edge(line[k - 1].vertex, line[k].vertex));
  std::ranges::sort(sharp);
  auto mesh = std::make_unique<FreeMesh>(result.mesh, frame.jets, result.vertex_size, sharp, frame.corners, tolerances, *frame.charts,
                                         cad, placed->added, std::move(placed->triangles));
  for (std::size_t line = 0; line < worked.size(); ++line) {
    worked[line].left = std::move(placed->lines[line]);
    for (std::size_t k = 0; k < worked[line].left.size(); ++k)
      if (const KeptPlaces& at = placed->on_line[line][k]; !at.empty())
        mesh->put_kept(worked[line].left[k].vertex, at, mesh->wanted_at(at));
  }
  mesh->budget = {.price = 0, .mean = good_shape};
  std::vector<std::int32_t> around = remesh_lines(*mesh, worked, {tolerances.deviation, tolerances.share_of_size}, monitor);
  around.insert(around.end(), placed->seams.begin(), placed->seams.end());
  if (!around.empty()) remesh(*mesh, monitor, true, false, around);
  raise_worst(*mesh, good_worst, monitor);
  return StartedMesh{std::move(mesh), std::move(worked)};
}

void take(FreedMesh&& made, RemeshingFrame& frame, CompositeResult& result, Monitor& monitor) {
  for (std::size_t f = 0; f < made.mesh.faces.size(); ++f)
    if (made.mesh.faces[f].status != result.mesh.faces[f].status)
      monitor.message(Level::warning, made.mesh.faces[f].why);
  static_cast<SizedMesh&>(result) = std::move(made);
  result.atlas = std::move(frame.charts);
}

}  // namespace

SurfaceTolerances surface_tolerances(const CompositeOptions& options, bool by_direction, double angle_slack) {
  const GeometricLimits limits = geometric_limits(options.size);
  // What is folded by less than the sharp angle may be flattened.
  const double folded = std::min(usual_angle / 2 + options.sharp_angle, most_angle);
  SurfaceTolerances tolerances{.angle_deg = std::max(usual_angle, folded), .deviation = 0, .share_of_size = usual_deviation};
  if (std::isfinite(limits.edge_angle_deg)) tolerances.angle_deg = limits.edge_angle_deg * angle_slack;
  if (std::isfinite(limits.deviation)) tolerances.deviation = limits.deviation;
  if (by_direction && !options.size.geo_guarantee) tolerances.angle_deg = std::max(tolerances.angle_deg, leaning_angle);
  return tolerances;
}

void make_elements_of_frame(RemeshingFrame& frame, Cad& cad, const CompositeOptions& options, CompositeResult& result,
                            Monitor& monitor) {
  const SurfaceTolerances tolerances = surface_tolerances(options, frame.charts->by_direction(), frame.angle_slack);
  frame.workers = {options, cad};
  FreedMesh made = reassembled(result.mesh, start_free_mesh(cad, tolerances, result, frame), frame, monitor);
  if (frame.elements) frame.elements(result.mesh, made);
  take(std::move(made), frame, result, monitor);
}

std::string mend_in_frame(RemeshingFrame& frame, double least_mean, Cad& cad, const CompositeOptions& options,
                          CompositeResult& result, Monitor& monitor) {
  const SurfaceTolerances tolerances = surface_tolerances(options, frame.charts->by_direction(), frame.angle_slack);
  frame.workers = {options, cad};
  std::optional<StartedMesh> placed = mended(cad, tolerances, result, frame, monitor);
  if (!placed) return "it is not made in planes";
  const bool poor = summarise_shapes(*placed->free, options.threads, monitor).mean < least_mean;
  FreedMesh made = reassembled(result.mesh, std::move(*placed), frame, monitor);
  Intersections found = find_crossings(made.mesh, options, monitor);
  if (found.count > 0 && found.count > find_crossings(result.mesh, options, monitor).count) return "triangles would cross";
  if (poor) return "shapes would be poor";
  std::string why = why_worse(made.mesh, result.mesh, options.threads, monitor);
  if (!why.empty()) return why;
  if (result.report.crossings >= 0) result.report.crossings = found.count, result.crossings = std::move(found.pairs);
  take(std::move(made), frame, result, monitor);
  return "";
}

std::string remesh_in_frame(RemeshingFrame& frame, Cad& cad, const CompositeOptions& options, CompositeResult& result,
                            Monitor& monitor) {
  frame.workers = {options, cad};
  Tries::Outcome outcome = Tries(frame, cad, options, result, monitor).run();
  if (!outcome.why.empty()) return outcome.why;
  if (result.report.crossings >= 0)
    result.report.crossings = outcome.crossings.count, result.crossings = std::move(outcome.crossings.pairs);
  if (frame.elements) {
    frame.elements(result.mesh, outcome.made);
    result.report.crossings = -1;  // those of straight triangles say nothing of these
    result.crossings.clear();
  }
  take(std::move(outcome.made), frame, result, monitor);
  return "";
}

bool free_from_patches(const CurveModel& model, std::span<const DiscreteCurve> curves, const CompositeOptions& options,
                       bool by_direction, const ElementMaker& elements, CompositeResult& result, Monitor& monitor) {
  RemeshingFrame frame = frame_of(model, options, by_direction, result, monitor);
  give_makers(model, curves, elements, result, frame);
  const std::string why = remesh_in_frame(frame, model.cad, options, result, monitor);
  if (!why.empty()) monitor.message(Level::warning, "the mesh stays as its patches made it: " + why);
  return why.empty();
}

void free_elements_from_patches(const CurveModel& model, std::span<const DiscreteCurve> curves, const CompositeOptions& options,
                                bool by_direction, const ElementMaker& elements, CompositeResult& result, Monitor& monitor) {
  RemeshingFrame frame = frame_of(model, options, by_direction, result, monitor);
  give_makers(model, curves, elements, result, frame);
  make_elements_of_frame(frame, model.cad, options, result, monitor);
}

}  // namespace carreau
