// SPDX-License-Identifier: BSD-3-Clause
#include "surface/independent/independent.h"

#include <algorithm>
#include <cmath>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "mesh/flat_mesh.h"
#include "support/infinity.h"
#include "surface/independent/base/thresholds.h"
#include "surface/independent/edits/edge_edits.h"
#include "surface/independent/edits/remeshing.h"
#include "surface/independent/edits/worst_first.h"
#include "surface/independent/placed_mesh.h"
#include "surface/independent/reassembly.h"
#include "surface/independent/tries.h"

namespace carreau {

namespace {

using namespace thresholds::independent;

// The metrics that patches were meshed with, at their vertices; none if they have no direction.
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

// Repairs a mesh from parametric remeshing: its seams, and its bad triangles.
std::optional<StartedMesh> mended(Cad& cad, const SurfaceTolerances& tolerances, double least_mean,
                                  const CompositeResult& result, RemeshingFrame& frame, Monitor& monitor) {
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
  mesh->budget = {.price = placed->kept.empty() ? 0 : high_price, .mean = good_shape};
  std::vector<std::int32_t> around = remesh_lines(*mesh, worked, {tolerances.deviation, tolerances.share_of_size}, monitor);
  around.insert(around.end(), placed->seams.begin(), placed->seams.end());
  around.insert(around.end(), placed->kept.begin(), placed->kept.end());
  if (!around.empty()) remesh(*mesh, monitor, true, false, around);
  if (summarise_shapes(*mesh, frame.workers.threads, monitor).mean < least_mean) {
    mesh->budget.price = high_price;
    for (int round = 0; round < most_line_rounds; ++round) {
      const std::vector<std::int32_t> changed =
          remesh_lines(*mesh, worked, {tolerances.deviation, tolerances.share_of_size}, monitor);
      if (round > 0 && changed.empty()) break;
      remesh_divided(*mesh, frame.workers, monitor, true, true,
                     round > 0 ? std::span<const std::int32_t>(changed) : std::span<const std::int32_t>());
    }
  }
  raise_worst(*mesh, good_worst, monitor);
  return StartedMesh{std::move(mesh), std::move(worked)};
}

// Halves the longest edges of triangles that cross: their parts are nearer to the surface. Then the mesh around
// follows, as near as it is.
void untangle(FreeMesh& mesh, const Intersections& found, const SurfaceMesh& made, Monitor& monitor) {
  mesh.update_guards();
  std::map<std::array<double, 3>, std::int32_t> at;
  const auto key = [](const Vec3& p) { return std::array{p[0], p[1], p[2]}; };
  for (const EditableMesh::Triangle& t : mesh.triangles())
    if (t[0] >= 0)
      for (const std::int32_t v : t) at.emplace(key(mesh.position(v)), v);
  const FlatMesh flat = flatten(made, false);
  std::vector<std::int32_t> around;
  for (const TriangleIntersection& pair : found.pairs)
    for (const std::int32_t t : pair.triangles) {
      std::array<std::pair<double, std::array<std::int32_t, 2>>, 3> edges;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::int32_t v = at.at(key(flat.vertices[flat.triangles[t][i]])),
                           w = at.at(key(flat.vertices[flat.triangles[t][(i + 1) % 3]]));
        edges[i] = {-mesh.length(v, w), {v, w}};
        around.push_back(v);
      }
      std::ranges::sort(edges);
      for (const auto& [length, edge] : edges) {
        const auto quad = mesh.mesh().quad_between({0, edge[0]}, edge[1]);
        if (!quad) continue;
        const auto middle = halve_edge(mesh, *quad);
        if (!middle) continue;
        around.push_back(*middle);
        break;
      }
    }
  remesh(mesh, monitor, true, false, around);
}

// Marks the triangles of the atlas that have a corner near a place where triangles cross.
void keep_around(const Intersections& found, const FreedMesh& made, const SurfaceMesh& before, RemeshingFrame& frame) {
  const FlatMesh flat = flatten(made.mesh, false);
  const auto& triangles = frame.charts->triangles();
  frame.kept.assign(triangles.size(), 0);
  for (const TriangleIntersection& pair : found.pairs) {
    const double far = guarded_sizes * made.vertex_size[flat.triangles[pair.triangles[0]][0]];
    for (std::size_t t = 0; t < triangles.size(); ++t)
      if (std::ranges::any_of(triangles[t].vertex,
                              [&](std::int32_t v) { return norm(before.vertices[v] - pair.place) <= far; }))
        frame.kept[t] = 1;
  }
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
  // Folds of less than the sharp angle may be flattened.
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
  std::optional<StartedMesh> placed = mended(cad, tolerances, least_mean, result, frame, monitor);
  if (!placed) return "parametric remeshing is not possible";
  std::optional<std::int64_t> crossings_before;
  std::int64_t first = 0, last = 0;
  bool keeps = false;
  for (int round = 0;; ++round) {
    FreedMesh made = reassembled(result.mesh, std::move(*placed), frame, monitor);
    Intersections found = find_crossings(made.mesh, options, monitor);
    if (found.count > 0 && !crossings_before) crossings_before = find_crossings(result.mesh, options, monitor).count;
    if (found.count > 0 && found.count > *crossings_before) {
      monitor.message(Level::debug, std::to_string(found.count) + " pairs of triangles cross");
      const bool stays = round > 0 && found.count >= last;
      const bool all_found = found.count == static_cast<std::int64_t>(found.pairs.size());
      if (round == most_untanglings || (stays && keeps) || !all_found) return "triangles would cross";
      if (round == 0) first = found.count;
      last = found.count;
      guard_around(found, made, *frame.charts);
      if (!stays) {
        untangle(*placed->free, found, made.mesh, monitor);
        continue;
      }
      // Edits do not help: there the triangles of the atlas stay.
      keeps = true, last = first;
      keep_around(found, made, result.mesh, frame);
      placed = mended(cad, tolerances, least_mean, result, frame, monitor);
      if (!placed) return "parametric remeshing is not possible";
      continue;
    }
    std::string why = why_worse(made.mesh, result.mesh, options.threads, monitor);
    if (!why.empty()) return why;
    if (result.report.crossings >= 0) result.report.crossings = found.count, result.crossings = std::move(found.pairs);
    take(std::move(made), frame, result, monitor);
    return "";
  }
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
    result.report.crossings = -1;  // crossings of straight triangles do not apply to curved elements
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
  if (!why.empty()) monitor.message(Level::warning, "no cross-patch remeshing: " + why);
  return why.empty();
}

void free_elements_from_patches(const CurveModel& model, std::span<const DiscreteCurve> curves, const CompositeOptions& options,
                                bool by_direction, const ElementMaker& elements, CompositeResult& result, Monitor& monitor) {
  RemeshingFrame frame = frame_of(model, options, by_direction, result, monitor);
  give_makers(model, curves, elements, result, frame);
  make_elements_of_frame(frame, model.cad, options, result, monitor);
}

}  // namespace carreau
