// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/cross_patch.h"

#include <algorithm>
#include <memory>
#include <string>

#include "surface/remesh/base/thresholds.h"
#include "surface/remesh/strategies.h"

namespace carreau {

namespace {

using namespace thresholds::remesh;

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
  return most > min_anisotropy ? metrics : PlaneMetrics{};
}

// Keeps references to all arguments.
std::unique_ptr<RemeshingFrame> frame_of(const CurveModel& model, std::span<const DiscreteCurve> curves,
                                         const CompositeOptions& options, bool by_direction, const ElementMaker& elements,
                                         const CompositeResult& result, Monitor& monitor) {
  const SurfaceMesh& mesh = result.mesh;
  auto made = std::make_unique<RemeshingFrame>();
  RemeshingFrame& frame = *made;
  frame.jets = evaluate_vertices(mesh, model.cad, monitor);
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
  if (elements) frame.elements = [&](const SurfaceMesh& before, CrossPatchResult& freed) { elements(before, frame, freed); };
  frame.geometry = [&, curves](const SharpLine& line) {
    return std::make_unique<LinePlaces>(line, mesh, model, curves, *frame.charts, model.cad);
  };
  return made;
}

}  // namespace

bool remesh_across_patches(const CurveModel& model, std::span<const DiscreteCurve> curves, const CompositeOptions& options,
                           bool by_direction, const ElementMaker& elements, CompositeResult& result, Monitor& monitor) {
  const auto frame = frame_of(model, curves, options, by_direction, elements, result, monitor);
  const std::string why = remesh_by_strategies(*frame, model.cad, options, result, monitor);
  if (!why.empty()) monitor.message(Level::warning, "no cross-patch remeshing: " + why);
  return why.empty();
}

void make_elements_across_patches(const CurveModel& model, std::span<const DiscreteCurve> curves, const CompositeOptions& options,
                                  bool by_direction, const ElementMaker& elements, CompositeResult& result, Monitor& monitor) {
  const auto frame = frame_of(model, curves, options, by_direction, elements, result, monitor);
  make_elements_of_frame(*frame, model.cad, options, result, monitor);
}

}  // namespace carreau
