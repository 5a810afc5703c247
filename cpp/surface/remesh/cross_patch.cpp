// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/cross_patch.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "model/bucket_sort.h"
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

/// Edges and vertices of fixed parts, ascending.
struct FixedTriangles {
  std::vector<MeshEdge> border, inner;       ///< on curves, and others
  std::vector<std::int32_t> vertices, ends;  ///< all, and the ends of curves
};

// Both lists are ascending.
template <typename T>
std::vector<T> joined(const std::vector<T>& list, const std::vector<T>& more) {
  std::vector<T> all;
  all.reserve(list.size() + more.size());
  std::set_union(list.begin(), list.end(), more.begin(), more.end(), std::back_inserter(all));
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

template <typename T>
void sort_uniquely(std::vector<T>& list) {
  std::ranges::sort(list);
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

FixedTriangles fixed_triangles(const SurfaceMesh& mesh, const FixedParts& fixed) {
  FixedTriangles found;
  std::vector<char> of_curve(mesh.vertices.size(), 0), stays(mesh.vertices.size(), 0);
  for (std::size_t c = 0; c < fixed.curves.size(); ++c) {
    const std::vector<std::int32_t>& chain = mesh.curves[c].vertices;
    if (fixed.curves[c] == 0 || chain.size() < 2) continue;
    for (std::size_t k = 1; k < chain.size(); ++k) found.border.push_back(mesh_edge(chain[k - 1], chain[k]));
    for (const std::int32_t v : chain) of_curve[v] = stays[v] = 1;
    found.ends.insert(found.ends.end(), {chain.front(), chain.back()});
  }
  sort_uniquely(found.border);
  sort_uniquely(found.ends);
  for (std::size_t f = 0; f < fixed.faces.size(); ++f) {
    if (fixed.faces[f] == 0) continue;
    const FaceMesh& face = mesh.faces[f];
    for (const auto& t : face.triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const MeshEdge edge = mesh_edge(face.vertex[t[i]], face.vertex[t[(i + 1) % 3]]);
        const bool of_curves = of_curve[edge[0]] != 0 && of_curve[edge[1]] != 0;
        if (!of_curves || !std::ranges::binary_search(found.border, edge)) found.inner.push_back(edge);
        stays[face.vertex[t[i]]] = 1;
      }
  }
  bucket_sort(found.inner, mesh.vertices.size(), [](const MeshEdge& e) { return e[0]; });
  found.inner.erase(std::unique(found.inner.begin(), found.inner.end()), found.inner.end());
  for (std::size_t v = 0; v < stays.size(); ++v)
    if (stays[v] != 0) found.vertices.push_back(static_cast<std::int32_t>(v));
  return found;
}

// Keeps references to all arguments.
std::unique_ptr<RemeshingFrame> frame_of(const CurveModel& model, std::span<const DiscreteCurve> curves,
                                         const CompositeOptions& options, bool by_direction, const FixedParts& fixed,
                                         const ElementMaker& elements, const CompositeResult& result, Monitor& monitor) {
  const SurfaceMesh& mesh = result.mesh;
  auto made = std::make_unique<RemeshingFrame>();
  RemeshingFrame& frame = *made;
  frame.jets = evaluate_vertices(mesh, model.cad, monitor);
  const double angle = options.sharp_angle;
  frame.sharp = find_sharp_edges(mesh, frame.jets, angle);
  const FixedTriangles stays = fixed_triangles(mesh, fixed);
  frame.sharp = joined(frame.sharp, stays.border);
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
  frame.corners = joined(frame.corners, stays.ends);
  frame.lines = find_lines(mesh, frame.sharp, frame.corners);
  frame.corners = joined(frame.corners, stays.vertices);
  frame.sharp = joined(frame.sharp, stays.inner);
  if (elements) frame.elements = [&](const SurfaceMesh& before, CrossPatchResult& freed) { elements(before, frame, freed); };
  frame.geometry = [&, curves](const SharpLine& line) {
    return std::make_unique<LinePlaces>(line, mesh, model, curves, *frame.charts, model.cad);
  };
  return made;
}

}  // namespace

bool remesh_across_patches(const CurveModel& model, std::span<const DiscreteCurve> curves, const CompositeOptions& options,
                           bool by_direction, const FixedParts& fixed, const ElementMaker& elements, CompositeResult& result, Monitor& monitor) {
  const auto frame = frame_of(model, curves, options, by_direction, fixed, elements, result, monitor);
  const std::string why = remesh_by_strategies(*frame, model.cad, options, result, monitor);
  if (!why.empty()) monitor.message(Level::warning, "no cross-patch remeshing: " + why);
  return why.empty();
}

void make_elements_across_patches(const CurveModel& model, std::span<const DiscreteCurve> curves, const CompositeOptions& options,
                                  bool by_direction, const FixedParts& fixed, const ElementMaker& elements, CompositeResult& result,
                                  Monitor& monitor) {
  const auto frame = frame_of(model, curves, options, by_direction, fixed, elements, result, monitor);
  make_elements_of_frame(*frame, model.cad, options, result, monitor);
}

}  // namespace carreau
