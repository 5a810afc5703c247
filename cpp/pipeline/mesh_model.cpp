// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/mesh_model.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>
#include <vector>

#include "pipeline/base/inspector.h"
#include "pipeline/base/run.h"
#include "pipeline/faces/same_hosts.h"
#include "pipeline/mesh_rounds.h"
#include "pipeline/parts/shares.h"
#include "surface/assembly/cracks.h"
#include "surface/elements/cross_patch/invalid_elements.h"

namespace carreau {

namespace {

// Parameters of vertices on curves. Sides of narrow faces that have become one curve have none: their vertices have moved.
void place_on_curves(CompositeRun& run) {
  const SurfaceMesh& mesh = run.result.mesh;
  if (!mesh.independent) run.result.curve_parameters.assign(mesh.curves.size(), {});
  for (std::size_t c = 0; c < run.curves.size(); ++c) {
    if (mesh.independent && !mesh.curves[c].loose) continue;  // known already
    const DiscreteCurve& curve = run.curves[c];
    const std::vector<std::int32_t>& chain = mesh.curves[c].vertices;
    if (chain.size() < 2 || chain.size() != curve.xyz.size()) continue;
    const auto stays = [&mesh](std::int32_t v, const Vec3& xyz) { return mesh.vertices[v] == xyz; };
    if (!std::equal(chain.begin(), chain.end(), curve.xyz.begin(), stays)) continue;
    const auto owner = static_cast<std::size_t>(curve.owner);
    const CurveUse& use = run.topology.curves[c].uses[owner];
    run.result.curve_parameters[c] = {run.curve_model.face_ref(use), use.curve + 1, curve.t_of_use[owner]};
  }
}

// Halved elements and vanishing faces change edges of curves. A warning names the curves whose edges were prescribed.
void report_prescribed(CompositeRun& run) {
  const SurfaceMesh& mesh = run.result.mesh;
  for (const DiscreteCurve& curve : run.curves) {
    if (!curve.prescribed) continue;
    const std::vector<std::int32_t>& chain = mesh.curves[static_cast<std::size_t>(curve.curve)].vertices;
    const auto stays = [&mesh](std::int32_t v, const Vec3& xyz) {
      return mesh.vertices[static_cast<std::size_t>(v)] == xyz;
    };
    if (chain.empty() || std::equal(chain.begin(), chain.end(), curve.xyz.begin(), curve.xyz.end(), stays)) continue;
    run.report(Level::warning, Where{.curve = run.topology.curves[static_cast<std::size_t>(curve.curve)].ref}.prefix() +
                                "the mesh has " + std::to_string(chain.size() - 1) + " edges on it, and not the " +
                                std::to_string(curve.segments()) +
                                " that are prescribed: its elements or narrow faces need others");
  }
}

// Periodic corners become exact images of each other.
Topology with_places(Topology topology, const std::vector<std::pair<int, Vec3>>& places) {
  for (const auto& [corner, place] : places) topology.points[static_cast<std::size_t>(corner)].position = place;
  return topology;
}

LayerCurves layer_curves(const Model& model, const Topology& topology, const std::vector<CurveLayers>& given,
                         const CompositeOptions& options) {
  return {model, topology, given, has_quads_only(options.element), has_quads_only(options.element) || is_quadratic(options.element)};
}

bool any_prescribed(const CompositeRun& run) {
  return std::any_of(run.curves.begin(), run.curves.end(), [](const DiscreteCurve& c) { return c.prescribed; });
}

// Crossings first: elements are made of the triangles that are left. With layers, one inspector finds all faults beside rows.
std::vector<std::unique_ptr<Inspector>> inspectors_of(CompositeRun& run) {
  std::vector<std::unique_ptr<Inspector>> inspectors;
  if (run.options.crossing_rounds > 0 && !run.periodic.pairs.empty())
    inspectors.push_back(make_periodic_inspector());
  if (run.options.crossing_rounds > 0 && run.layers.empty()) inspectors.push_back(make_crossing_inspector());
  if (run.options.independent && any_prescribed(run))
    run.report(Level::warning, "no cross-patch remeshing: edges of curves are prescribed");
  else if (run.options.independent && !run.layers.empty())
    run.report(Level::warning, "no cross-patch remeshing: layers grow from curves");
  else if (run.options.independent)
    inspectors.push_back(make_cross_patch_inspector());
  if (!run.layers.empty() || run.options.element != Element::p1)
    inspectors.push_back(make_element_inspector());
  return inspectors;
}

}  // namespace

CompositeResult mesh_composite(const Model& model, const Topology& topology, const ModelSupports& supports, Cad& cad,
                               const CompositeOptions& options, Monitor& monitor, MeshLayers* layers) {
  const auto start = std::chrono::steady_clock::now();
  PeriodicModel periodic = find_periodic({model, topology, supports.of_face, cad}, supports.diag);
  const Topology placed = periodic.placed.empty() ? Topology{} : with_places(topology, periodic.placed);
  const Topology& used = periodic.placed.empty() ? topology : placed;
  CompositeRun run(model, used, supports, cad, options, std::move(periodic), monitor);
  if (layers != nullptr) run.layers = layer_curves(model, topology, layers->given, options);
  if (run.options.parts && !run.layers.empty()) run.make_whole();
  const auto agree = [&] {
    if (options.executor.team != nullptr) run.options.max_triangles = least_of(*options.executor.team, run.options.max_triangles);
  };
  agree();
  grade_sizes(run);
  discretise_curves(run);
  find_narrow(run);
  if (run.options.parts && !run.narrow.vanishing.curve.empty()) run.make_whole(), agree();
  MeshRounds rounds(run);
  rounds.mesh_first();
  for (const std::unique_ptr<Inspector>& inspector : inspectors_of(run)) rounds.refine(*inspector);
  if (!run.options.parts && fail_unsound_faces(run.result, run.options.executor.threads, run.monitor)) {
    run.result.report.crossings = -1;  // numbers of triangles have changed
    run.result.crossings.clear();
  }
  place_on_curves(run);
  report_prescribed(run);
  link_periodic(run);
  if (options.cracks) open_cracks(run.result);
  if (layers != nullptr) layers->cells = std::move(run.layer_cells);
  run.result.report.calls = cad.counts();
  run.result.report.seconds_total = seconds_since(start);
  return std::move(run.result);
}

}  // namespace carreau
