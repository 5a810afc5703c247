// SPDX-License-Identifier: BSD-3-Clause
#include "surface/discrete/discrete_run.h"

#include <algorithm>
#include <chrono>
#include <numbers>

#include "support/error.h"
#include "surface/discrete/periodic_images.h"
#include "surface/discrete/periodic_triangles.h"
#include "surface/discrete/start_mesh.h"
#include "surface/elements/cross_patch/cross_patch_elements.h"
#include "surface/remesh/strategies.h"
#include "surface/remesh/planes/projected_mesh.h"
#include "surface/elements/quads/quadrilaterals.h"

namespace carreau {

namespace {

// Turns the cut triangles into a mesh of straight triangles.
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

/// Longest edges, in sizes, of the atlas for parametric remeshing: its triangles show where the surface bends.
constexpr double longest_in_planes = 4;
/// Relative difference below which sizes are equal.
constexpr double same_size = 1e-6;

/// Q2. Below this mean quality the input's triangles are as large as its details: local remeshing, with a penalty on
/// collapses, gives better meshes.
constexpr double min_mean_shape = 0.93;

/// The state of a run: the triangles, cut by the sizes.
struct Start {
  discrete::RefinedMesh refined;
  MeshSizes wanted;
  CompositeResult result;
  PeriodicTriangles periodic = {};
};

/// Finds pairs, and gives both sides the smaller sizes: their lines need as many vertices. Returns whether they have.
bool begin_periodic(const Model& model, const discrete::DiscreteCad& surface, Start& start, double& longest_of_lines) {
  start.periodic = find_periodic_triangles(model, surface.discrete().mesh().diagonal(), surface.discrete().mesh().vertices.size(), start.result.mesh);
  const double least = share_sizes(start.periodic, start.result.mesh, start.wanted.h);
  start.result.vertex_size = start.wanted.h;
  const bool enough = least >= longest_of_lines * (1 - same_size);
  longest_of_lines = std::min(longest_of_lines, least);
  return enough;
}

void begin(const Model& model, const discrete::DiscreteCad& surface, const DiscreteSizes& sizes,
           const CompositeOptions& options, double longest, Monitor& monitor, Start& start) {
  monitor.progress(Phase::curves, 0, 0);
  double longest_of_lines = 1;
  do {
    start.refined = refine_by_sizes(surface.discrete(), sizes, options, monitor, longest, longest_of_lines);
    start.wanted = sizes.at_vertices(start.refined, monitor);
    start.result = {};
    start.result.vertex_size = start.wanted.h;
    start.result.mesh = start_mesh(model, surface, start.refined);
  } while (!model.periodicities.empty() && !begin_periodic(model, surface, start, longest_of_lines));
  start.result.interfaces.resize(model.faces.size());
  start.result.spaces.resize(model.faces.size());
  monitor.progress(Phase::patches, 0, 0.2);
}

/// Returns whether elements are straight triangles with sizes without direction and without a geometric rule.
bool may_be_made_in_planes(const CompositeOptions& options, const MeshSizes& wanted) {
  return options.element == Element::p1 && !wanted.by_direction() && !geometric_limits(options.size).any();
}

/// If all sizes are equal the atlas need not be fine.
double longest_of_atlas(const MeshSizes& wanted) {
  const auto [least, most] = std::ranges::minmax_element(wanted.h);
  return *most <= (1 + same_size) * *least ? longest_in_planes : std::numbers::sqrt2;
}

bool make_in_planes(const discrete::DiscreteCad& surface, const CompositeOptions& options, Cad& cad, Monitor& monitor,
                    Start& start) {
  RemeshingFrame frame = start_frame(surface, start.refined, start.result.mesh, start.wanted, options, cad, monitor);
  if (!start.periodic.empty()) {
    frame.twin = start.periodic.twins(frame.lines.size());
    frame.corners.insert(frame.corners.end(), start.periodic.corners.begin(), start.periodic.corners.end());
    std::ranges::sort(frame.corners);
  }
  frame.made = [&](std::span<const WorkedLine> worked, const SurfaceTolerances& tolerances) {
    return make_projected_mesh(frame, start.result.mesh, start.wanted.h, worked, tolerances,
                               {.executor = options.executor, .max_triangles = options.max_triangles}, cad, monitor);
  };
  if (options.element != Element::p1)
    frame.elements = [&](const SurfaceMesh& before, CrossPatchResult& made) { make_cross_patch_elements(before, frame, options, cad, made, monitor); };
  const std::string why = remesh_from_planes(frame, min_mean_shape, cad, options, start.result, monitor);
  if (!why.empty()) monitor.message(Level::detail, "local instead of parametric remeshing: " + why);
  return why.empty();
}

// Runs the rest by local remeshing: collapses, splits and swaps edges until the mesh meets the sizes.
void make_by_edits(const discrete::DiscreteCad& surface, const CompositeOptions& options, Cad& cad, Monitor& monitor,
                   Start& start) {
  CompositeResult& result = start.result;
  RemeshingFrame frame = start_frame(surface, start.refined, result.mesh, start.wanted, options, cad, monitor);
  const auto atlas = frame.charts;
  if (options.element != Element::p1)
    frame.elements = [&](const SurfaceMesh& before, CrossPatchResult& made) {
      make_cross_patch_elements(before, frame, options, cad, made, monitor);
    };
  const std::string why = remesh_by_strategies(frame, cad, options, result, monitor);
  if (why.empty()) return;
  monitor.message(Level::warning, "no remeshing, the triangles are only divided by the sizes: " + why);
  if (frame.elements)
    make_elements_of_frame(frame, cad, options, result, monitor);
  else
    keep_as_it_is(atlas, result);
}

}  // namespace

CompositeResult mesh_discrete(const Model& model, const discrete::DiscreteCad& surface, Cad& cad,
                              const CompositeOptions& given, Monitor& monitor) {
  CompositeOptions options = given;
  options.size = enlarged(given.size, enlargement_for(given.element));
  const auto begun = std::chrono::steady_clock::now();
  const DiscreteSizes sizes(model, cad, surface, options);
  const MeshSizes known = sizes.at_vertices(unrefined(surface.discrete()), monitor);
  Start start;
  bool made = false;
  const bool periodic = !model.periodicities.empty();
  if (periodic && known.by_direction())
    throw InvalidArgument("faces given by triangles are periodic: sizes by direction are for patches alone, since only parametric remeshing divides periodic lines alike");
  if (periodic || may_be_made_in_planes(options, known)) {
    begin(model, surface, sizes, options, longest_of_atlas(known), monitor, start);
    made = make_in_planes(surface, options, cad, monitor, start);
  }
  if (periodic && !made)
    throw DomainError("faces given by triangles are periodic, and parametric remeshing is not possible: only it divides periodic lines alike");
  make_periodic(start.periodic, cad, start.result, monitor);
  if (!made) {
    begin(model, surface, sizes, options, std::numbers::sqrt2, monitor, start);
    make_by_edits(surface, options, cad, monitor, start);
  }
  CompositeResult& result = start.result;
  result.report.calls = cad.counts();
  result.report.diag = surface.discrete().mesh().diagonal();
  result.report.seconds_total = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  return std::move(start.result);
}

}  // namespace carreau
