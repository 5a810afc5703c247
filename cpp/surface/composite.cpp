// SPDX-License-Identifier: BSD-3-Clause
#include "surface/composite.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "surface/assembly/cracks.h"
#include "surface/improve/adjacent_lengths.h"
#include "surface/improve/adjacent_sizes.h"
#include "surface/parts/shares.h"
#include "surface/run.h"
#include "surface/team/same_hosts.h"
#include "surface/thresholds.h"

namespace carreau {

namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void mesh_discretised(CompositeRun& run) {
  refine_boundaries(run);
  if (run.options.crossing_rounds > 0 || run.options.element != Element::p1) run.cut_curves = run.curves;
  mesh_patches(run);
  assemble_patches(run);
}

// Neighbours of faces that are to vanish are meshed without their end caps. Where some face cannot vanish all are
// meshed, end caps too, and as many vanish as can.
void mesh_without_narrow(CompositeRun& run) {
  const std::vector<DiscreteCurve> before = run.curves;
  mesh_discretised(run);
  if (collapse_narrow_together(run)) return;
  run.begin += (1 - run.begin) * (thresholds::patches::curves_share + thresholds::patches::patches_share);
  run.narrow.vanishing = {};
  run.curves = before;
  mesh_discretised(run);
  collapse_narrow_one_by_one(run);
}

// What the gradation promises of neighbouring edges is kept on the assembled mesh, too.
void even_out(CompositeRun& run) {
  const CompositeOptions& options = run.options;
  if (run.slope() == 0) return;
  if (run.rules.uses_metrics())
    even_out_sizes(tolerated_gradation * options.gradation,
                   options.size.geo_guarantee ? geometric_limits(options.size) : GeometricLimits{}, run.rules, run.cad,
                   run.result, run.monitor);
  else
    even_out_lengths(adjacent_lengths * options.gradation, run.rules, run.cad, run.result, run.monitor);
}

// Of curves whose vertices are where they were cut: not of sides of narrow faces that have become one.
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

// Elements that are halved, and faces that vanish, change edges of curves: not without a word where these were told.
void tell_prescribed(CompositeRun& run) {
  const SurfaceMesh& mesh = run.result.mesh;
  for (const DiscreteCurve& curve : run.curves) {
    if (!curve.prescribed) continue;
    const std::vector<std::int32_t>& chain = mesh.curves[static_cast<std::size_t>(curve.curve)].vertices;
    const auto stays = [&mesh](std::int32_t v, const Vec3& xyz) {
      return mesh.vertices[static_cast<std::size_t>(v)] == xyz;
    };
    if (chain.empty() || std::equal(chain.begin(), chain.end(), curve.xyz.begin(), curve.xyz.end(), stays)) continue;
    run.say(Level::warning, Where{.curve = run.topology.curves[static_cast<std::size_t>(curve.curve)].ref}.prefix() +
                                "the mesh has " + std::to_string(chain.size() - 1) + " edges on it, and not the " +
                                std::to_string(curve.segments()) +
                                " that are prescribed: its elements or narrow faces need others");
  }
}

bool any_prescribed(const CompositeRun& run) {
  return std::any_of(run.curves.begin(), run.curves.end(), [](const DiscreteCurve& c) { return c.prescribed; });
}

}  // namespace

CompositeResult mesh_composite(const Model& model, const Topology& topology, const ModelSupports& supports, Cad& cad,
                               const CompositeOptions& options, Monitor& monitor) {
  const auto start = std::chrono::steady_clock::now();
  CompositeRun run(model, topology, supports, cad, options, monitor);
  if (options.team != nullptr) run.options.max_triangles = least_of(*options.team, run.options.max_triangles);
  if (run.options.parts) refuse_parts(run.options, run.rules);
  grade_sizes(run);
  discretise_curves(run);
  find_narrow(run);
  if (run.options.parts) refuse_narrow_parts(run.narrow);
  const NarrowModel narrow = run.narrow;
  const auto mesh = [&] {
    run.narrow = narrow;
    if (narrow.vanishing.curve.empty())
      mesh_discretised(run);
    else
      mesh_without_narrow(run);
    even_out(run);
  };
  mesh();
  part_crossing_triangles(run, mesh);
  run.known.end();
  bool is_free = false;
  if (options.independent && any_prescribed(run))
    run.say(Level::warning, "the mesh stays as its patches made it: edges of curves are prescribed");
  else
    is_free = options.independent && make_free(run, mesh);
  if (!is_free) make_elements(run, mesh);
  place_on_curves(run);
  tell_prescribed(run);
  if (options.cracks) open_cracks(run.result);
  run.result.report.calls = cad.counts();
  run.result.report.seconds_total = seconds_since(start);
  return std::move(run.result);
}

}  // namespace carreau
