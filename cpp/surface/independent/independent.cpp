#include "surface/independent/independent.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "mesh/flat_mesh.h"
#include "mesh/intersections.h"
#include "surface/independent/reassembly.h"
#include "surface/independent/remeshing.h"
#include "surface/independent/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::independent;

SurfaceTolerances tolerances_of(const CompositeOptions& options) {
  const GeometricLimits limits = geometric_limits(options.size);
  SurfaceTolerances tolerances{.angle_deg = usual_angle, .deviation = 0, .share_of_size = usual_deviation};
  if (std::isfinite(limits.edge_angle_deg)) tolerances.angle_deg = limits.edge_angle_deg;
  if (std::isfinite(limits.deviation)) tolerances.deviation = limits.deviation;
  return tolerances;
}

std::int64_t crossings(const SurfaceMesh& mesh, int threads, Monitor& monitor) {
  const FlatMesh flat = flatten(mesh, false);
  return find_intersections(flat.vertices, flat.triangles, {.limit = 0, .threads = threads}, monitor).count;
}

/// Vertices - edges + triangles.
std::int64_t euler(const SurfaceMesh& mesh) {
  std::vector<MeshEdge> edges;
  std::vector<char> used(mesh.vertices.size(), 0);
  for (const FaceMesh& face : mesh.faces)
    for (const auto& t : face.triangles)
      for (int i = 0; i < 3; ++i) {
        edges.push_back(mesh_edge(face.vertex[t[i]], face.vertex[t[(i + 1) % 3]]));
        used[face.vertex[t[i]]] = 1;
      }
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return std::ranges::count(used, 1) - static_cast<std::int64_t>(edges.size()) +
         static_cast<std::int64_t>(mesh.triangle_count());
}

FreedMesh freed(const Topology& topology, const ModelSupports& supports, Cad& cad, const CompositeOptions& options,
                const CompositeResult& result, Monitor& monitor) {
  const SurfaceMesh& mesh = result.mesh;
  const VertexJets jets = evaluate_vertices(mesh, cad, monitor);
  std::vector<MeshEdge> sharp = find_sharp_edges(mesh, jets, options.sharp_angle);
  auto charts = std::make_unique<Charts>(mesh, sharp, result.vertex_size, cad, monitor);
  if (const std::vector<MeshEdge> twisted = charts->twisted(); !twisted.empty()) {
    sharp.insert(sharp.end(), twisted.begin(), twisted.end());
    std::ranges::sort(sharp);
    charts = std::make_unique<Charts>(mesh, sharp, result.vertex_size, cad, monitor);
  }
  const Topology* known = mesh.curves.size() == topology.curves.size() ? &topology : nullptr;
  const std::vector<std::int32_t> corners =
      find_corners(mesh, jets, *charts, sharp, known, supports, options.sharp_angle);
  const std::vector<SharpLine> lines = find_lines(mesh, sharp, corners);
  FreeMesh free(mesh, jets, result.vertex_size, sharp, corners, tolerances_of(options), *charts);
  const RemeshingReport report = remesh(free, monitor);
  monitor.message(Level::detail, "across borders: " + std::to_string(report.collapses) + " edges collapsed, " +
                                     std::to_string(report.splits) + " split, " + std::to_string(report.swaps) +
                                     " swapped, " + std::to_string(report.moves) + " moves of vertices, " +
                                     std::to_string(report.rounds) + " rounds");
  return reassemble(mesh, free, lines, corners, monitor);
}

}  // namespace

void free_from_patches(const Topology& topology, const ModelSupports& supports, Cad& cad,
                       const CompositeOptions& options, CompositeResult& result, Monitor& monitor) {
  FreedMesh made = freed(topology, supports, cad, options, result, monitor);
  const std::vector<std::string> defects = find_defects(made.mesh, {.closed = false, .limit = 1});
  const bool known = find_defects(result.mesh, {.closed = false, .limit = 1}).empty();
  std::string why;
  if (known && !defects.empty())
    why = defects.front();
  else if (euler(made.mesh) != euler(result.mesh))
    why = "its Euler number would differ";
  else if (crossings(made.mesh, options.threads, monitor) > crossings(result.mesh, options.threads, monitor))
    why = "more triangles would cross";
  if (!why.empty()) {
    monitor.message(Level::warning, "the mesh stays as its patches made it: " + why);
    return;
  }
  for (std::size_t f = 0; f < made.mesh.faces.size(); ++f)
    if (made.mesh.faces[f].status != result.mesh.faces[f].status)
      monitor.message(Level::warning, made.mesh.faces[f].why);
  result.mesh = std::move(made.mesh);
  result.vertex_size = std::move(made.vertex_size);
  result.curve_size = std::move(made.curve_size);
}

}  // namespace carreau
