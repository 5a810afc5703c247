// SPDX-License-Identifier: BSD-3-Clause
#include "surface/discrete/discrete_run.h"

#include <chrono>

#include "surface/discrete/start_mesh.h"
#include "surface/free_elements/free_elements.h"
#include "surface/projected/projected_mesh.h"
#include "surface/quads/quadrilaterals.h"

namespace carreau {

namespace {

// The mesh that the triangles were cut into, of straight triangles.
void keep_as_it_is(const std::shared_ptr<Charts>& atlas, CompositeResult& result) {
  result.atlas = atlas;
  result.feet.resize(result.mesh.faces.size());
  std::int32_t t = 0;
  for (std::size_t f = 0; f < result.mesh.faces.size(); ++f) {
    FaceMesh& face = result.mesh.faces[f];
    result.feet[f].resize(face.vertex.size());
    face.uv_face.assign(face.vertex.size(), static_cast<std::int32_t>(f));
    face.spread.assign(face.triangles.size(), 0);
    for (const auto& corners : face.triangles) {
      for (const std::int32_t v : corners) result.feet[f][static_cast<std::size_t>(v)] = t;
      ++t;
    }
  }
  for (const CurveMesh& curve : result.mesh.curves) {
    auto& of_curve = result.curve_size.emplace_back();
    for (const std::int32_t v : curve.vertices) of_curve.push_back(result.vertex_size[static_cast<std::size_t>(v)]);
  }
}

}  // namespace

CompositeResult mesh_discrete(const Model& model, const discrete::DiscreteCad& surface, Cad& cad,
                              const CompositeOptions& given, Monitor& monitor) {
  CompositeOptions options = given;
  options.size = enlarged(given.size, enlargement_for(given.element));
  const auto start = std::chrono::steady_clock::now();
  const DiscreteSizes sizes(model, cad, surface, options);
  monitor.progress(Phase::curves, 0, 0);
  const discrete::RefinedMesh refined = refine_by_sizes(surface.discrete(), sizes, options, monitor);
  CompositeResult result;
  const MeshSizes wanted = sizes.at_vertices(refined, monitor);
  result.vertex_size = wanted.h;
  result.mesh = start_mesh(model, surface, refined);
  result.interfaces.resize(model.faces.size());
  result.spaces.resize(model.faces.size());
  monitor.progress(Phase::patches, 0, 0.2);
  RemeshingFrame frame = start_frame(surface, refined, result.mesh, wanted, options, cad, monitor);
  const auto atlas = frame.charts;
  if (options.element != Element::p1)
    frame.elements = [&](const SurfaceMesh& before, FreedMesh& made) {
      make_free_elements(before, frame, options, cad, made, monitor);
    };
  if (!wanted.by_direction() && !geometric_limits(options.size).any())
    frame.made = [&](std::span<const WorkedLine> worked, const SurfaceTolerances& tolerances) {
      return make_projected_mesh(frame, result.mesh, wanted.h, worked, tolerances,
                                 {.threads = options.threads, .max_triangles = options.max_triangles}, cad, monitor);
    };
  const std::string why = remesh_in_frame(frame, cad, options, result, monitor);
  if (!why.empty()) {
    monitor.message(Level::warning, "the mesh stays as the triangles are, cut by the sizes: " + why);
    if (frame.elements)
      make_elements_of_frame(frame, cad, options, result, monitor);
    else
      keep_as_it_is(atlas, result);
  }
  result.report.calls = cad.counts();
  result.report.diag = surface.discrete().mesh().diagonal();
  result.report.seconds_total = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace carreau
