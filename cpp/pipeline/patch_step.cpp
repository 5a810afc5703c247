// SPDX-License-Identifier: BSD-3-Clause
// The patches: sample, mesh, lift of every face, on several threads.
#include <algorithm>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>

#include "pipeline/base/run.h"
#include "pipeline/base/thresholds.h"
#include "pipeline/faces/dealt_faces.h"
#include "pipeline/faces/face_job.h"
#include "pipeline/faces/same_hosts.h"
#include "plane/kernel/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::patches;

// Short edges of all curves, or only of curves whose edges are prescribed.
std::vector<EdgeSizes::Source> short_edges(const CompositeRun& run, const FaceDomain& domain,
                                           const std::vector<Vec3>& xyz, bool of_all) {
  std::vector<EdgeSizes::Source> edges;
  for (const PlaneEdge& e : domain.plane.edges) {
    if (!of_all && (e.curve < 0 || !run.curves[static_cast<std::size_t>(e.curve)].prescribed)) continue;
    if (e.kind == PlaneEdgeKind::degenerate || static_cast<std::size_t>(std::max(e.a, e.b)) >= xyz.size()) continue;
    const double length = norm(xyz[e.b] - xyz[e.a]);
    if (length > 0 && length < short_share * std::min(domain.size[e.a], domain.size[e.b]))
      edges.push_back({xyz[e.a], xyz[e.b], length});
  }
  return edges;
}

/// The faces at work, and the triangles that they may still have.
struct PatchJobs {
  CompositeRun& run;
  std::vector<std::unique_ptr<SteppedTask>> jobs = {};
  std::vector<std::size_t> face_of = {};
  std::vector<EdgeSizes> short_edges = {};            // by face
  std::int64_t left = 0;                              // triangles still allowed
  std::optional<LimitError> first_beyond_limit = {};  // of faces that have too many by themselves
};

std::vector<EdgeSizes::Source> edges_to_grow_from(const CompositeRun& run, std::size_t f,
                                                  const std::vector<Vec3>& on_curves) {
  const double asked = run.options.edge_gradation;
  std::vector<EdgeSizes::Source> sources;
  if (run.isotropic()) sources = short_edges(run, *run.domains.domain[f], on_curves, asked > 0);
  if (run.finer.empty()) return sources;
  sources.insert(sources.end(), run.finer[f].begin(), run.finer[f].end());
  for (const FacePair& pair : run.periodic.pairs) {
    if (pair.master != static_cast<int>(f)) continue;
    const Isometry back = pair.map.inverse();
    for (const EdgeSizes::Source& edge : run.finer[pair.slave]) sources.push_back({back(edge.a), back(edge.b), edge.h});
  }
  return sources;
}

PatchInput input_of(PatchJobs& work, std::size_t f, std::vector<EdgeSizes::Source>& grow_from) {
  const CompositeRun& run = work.run;
  const FaceDomain& domain = *run.domains.domain[f];
  std::vector<Vec3> on_curves = positions_on_curves(domain, run.curves, run.topology);
  SizeLimits bound = run.limits();
  grow_from = edges_to_grow_from(run, f, on_curves);
  work.short_edges[f] = {grow_from, run.slope_of_edges()};
  if (!work.short_edges[f].empty()) bound.edges = &work.short_edges[f];
  return {.face = static_cast<int>(f),
          .ref = run.model.faces[f].ref,
          .domain = &domain,
          .curve_xyz = std::move(on_curves),
          .constant_size = bound.want_places() ? std::nullopt : run.rules.constant(),
          .is_plane = run.model.plane,
          .isotropic = run.isotropic(),
          .limits = bound,
          .slope = run.slope(),
          .executor = run.options.executor.alone(),
          .host_threads = asks_from_threads(run.options, run.cad) ? run.options.executor.threads : 1};
}

void keep_patch(PatchJobs& work, std::size_t f, FaceOutcome& outcome) {
  CompositeRun& run = work.run;
  run.patches[f] = std::move(outcome.patch);
  if (!outcome.layers.empty() || !run.layer_cells.empty()) {
    run.layer_cells.resize(run.model.faces.size());
    run.layer_cells[f] = std::move(outcome.layers);
    run.turned_at_rows.resize(run.model.faces.size());
    run.turned_at_rows[f] = std::move(outcome.turned);
  }
  run.keeper[f] = outcome.elsewhere ? outcome.elsewhere->rank : all_have;
  if (!outcome.remark.empty()) run.remarks[f] = outcome.remark;
  work.left -= outcome.elsewhere ? outcome.elsewhere->triangles : static_cast<std::int64_t>(run.patches[f]->plane.triangles.size());
  const std::int64_t most = run.options.max_triangles;
  if (work.left < 0)
    refuse_triangles(Where{.face = run.model.faces[f].ref}, static_cast<double>(most - work.left), most);
}

// Takes the patch of the round before.
bool keep_known(PatchJobs& work, std::size_t f, const PatchInput& input, const std::vector<EdgeSizes::Source>& grow_from) {
  std::optional<FaceOutcome> known = work.run.known.find(f, input, grow_from);
  if (!known) return false;
  work.run.result.spaces[f] = std::move(known->space);
  keep_patch(work, f, *known);
  work.run.is_known[f] = 1;
  return true;
}

// Makes a job of each face that has a domain and no mesh yet.
void make_jobs(PatchJobs& work) {
  CompositeRun& run = work.run;
  const bool reentrant = asks_from_threads(run.options, run.cad);
  work.short_edges.assign(run.model.faces.size(), {});
  for (std::size_t f = 0; f < run.model.faces.size(); ++f) {
    if (!run.domains.domain[f] || run.has_patch(f) || run.is_slave(f)) continue;
    std::vector<EdgeSizes::Source> grow_from;
    PatchInput input = input_of(work, f, grow_from);
    if (keep_known(work, f, input, grow_from)) continue;
    run.known.keep(f, input, std::move(grow_from));
    work.jobs.push_back(std::make_unique<FaceJob>(std::move(input), run.cad, run.rules, run.layers, run.options, reentrant));
    work.face_of.push_back(f);
  }
}

// Longest first, judged by boundaries: the triangles of a square are as the square of its edges.
std::vector<std::size_t> order_of_jobs(const PatchJobs& work) {
  const auto edges = [&](std::size_t i) { return work.run.domains.domain[work.face_of[i]]->plane.edges.size(); };
  std::vector<std::size_t> order(work.jobs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return edges(a) > edges(b); });
  return order;
}

/// Expected triangles by job, estimated from boundaries.
std::vector<double> expected_triangles(const PatchJobs& work) {
  std::vector<double> triangles;
  for (const std::size_t f : work.face_of) {
    const auto edges = static_cast<double>(work.run.domains.domain[f]->plane.edges.size());
    triangles.push_back(std::numbers::sqrt3 / 12 * edges * edges);  // unit equilateral triangles in a square
  }
  return triangles;
}

/// Faces that would occupy one process after others have finished, and that are large enough to be cut.
std::vector<std::size_t> faces_to_share(const std::vector<double>& triangles, int processes) {
  const double share = std::accumulate(triangles.begin(), triangles.end(), 0.0) / processes;
  std::vector<std::size_t> shared;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    if (triangles[i] > std::max(share, plane::triangles_a_piece)) shared.push_back(i);
  return shared;
}

void tell_progress(PatchJobs& work, std::size_t next) {
  if (next == work.jobs.size()) return;
  work.run.show_progress(Phase::patches, work.run.model.faces[work.face_of[next]].ref,
                ProgressShares::curves + ProgressShares::patches * static_cast<double>(next) / static_cast<double>(work.jobs.size()));
}

void finish(PatchJobs& work, std::size_t i, FaceOutcome outcome) {
  CompositeRun& run = work.run;
  const std::size_t f = work.face_of[i];
  CompositeReport& all = run.result.report;
  all.seconds_sampling += outcome.seconds_sampling;
  all.seconds_plane += outcome.seconds_plane;
  all.seconds_lift += outcome.seconds_lift;
  all.corrections += outcome.corrections;
  run.known.keep(f, outcome);
  run.result.spaces[f] = std::move(outcome.space);
  if (!work.first_beyond_limit) work.first_beyond_limit = outcome.beyond_limit;
  if (outcome.failure.empty())
    keep_patch(work, f, outcome);
  else
    run.fail(f, outcome.failure);
  work.jobs[i].reset();
  tell_progress(work, i + 1);
}

void mesh_here(PatchJobs& work) {
  CompositeRun& run = work.run;
  tell_progress(work, 0);
  const auto finished = [&](std::size_t i) { finish(work, i, static_cast<FaceJob&>(*work.jobs[i]).take_outcome()); };
  run_stepped(work.jobs, {.threads = run.options.executor.threads, .order = order_of_jobs(work), .on_finished = finished},
              run.monitor);
}

// Progress counts the faces that any process has begun: outcomes come all at once.
void mesh_in_team(PatchJobs& work, Team& team) {
  CompositeRun& run = work.run;
  require_same_curves(team, run);
  std::vector<double> expected = expected_triangles(work);
  const std::vector<std::size_t> shared = faces_to_share(expected, team.size());
  std::vector<std::size_t> order = order_of_jobs(work);
  std::erase_if(order, [&](std::size_t i) { return std::binary_search(shared.begin(), shared.end(), i); });
  mesh_dealt({.team = team,
              .jobs = work.jobs,
              .shared = shared,
              .order = std::move(order),
              .expected = std::move(expected),
              .least_shared = plane::triangles_a_piece,
              .threads = run.options.executor.threads,
              .parts = run.options.parts,
              .on_begun =
                  [&](std::size_t i, std::size_t begun) {
                    run.show_progress(Phase::patches, run.model.faces[work.face_of[i]].ref,
                             ProgressShares::curves + ProgressShares::patches * static_cast<double>(begun) / static_cast<double>(work.jobs.size()));
                  },
              .on_finished = [&](std::size_t i, FaceOutcome outcome) { finish(work, i, std::move(outcome)); }},
             run.monitor);
  require_same_surfaces(team, run);
}

void start_result(CompositeRun& run) {
  CompositeResult& result = run.result;
  const std::size_t n = run.model.faces.size();
  result.mesh = {};
  result.mesh.faces.resize(n);
  result.spaces.assign(n, std::nullopt);
  result.vertex_size.clear();
  result.curve_size.clear();
  result.gaps.clear();
  for (std::size_t f = 0; f < n; ++f) {
    const Face& face = run.model.faces[f];
    FaceMesh& mesh = result.mesh.faces[f];
    mesh.ref = face.ref;
    mesh.part_of = face.part_of;
    mesh.name = face.name;
    mesh.rgb = face.rgb;
    if (face.is_wire()) mesh.status = FaceStatus::wire;
  }
}

// All have made the patch.
void keep_in_turn(CompositeRun& run, std::size_t i, std::size_t f) {
  const Team& team = *run.options.executor.team;
  run.keeper[f] = static_cast<int>(i % static_cast<std::size_t>(team.size()));
  if (run.keeper[f] != team.rank()) run.patches[f].reset();
}

void carry_all(PatchJobs& work) {
  CompositeRun& run = work.run;
  carry_patches(run);
  for (const FacePair& pair : run.periodic.pairs)
    if (run.patches[pair.slave]) work.left -= static_cast<std::int64_t>(run.patches[pair.slave]->plane.triangles.size());
  if (work.left < 0) refuse_triangles({}, static_cast<double>(run.options.max_triangles - work.left), run.options.max_triangles);
}

void place_narrow_patches(CompositeRun& run) {
  for (std::size_t i = 0; i < run.between.size(); ++i) {
    const int f = run.narrow.strips[i].face;
    run.domains.domain[f] = std::move(run.between[i].domain);
    run.patches[f] = std::move(run.between[i].mesh);
    run.keeper[f] = all_have;
    if (run.options.parts) keep_in_turn(run, i, static_cast<std::size_t>(f));
  }
}

}  // namespace

void mesh_patches(CompositeRun& run) {
  start_result(run);
  run.remarks.clear();
  run.halved = false;
  run.is_known.assign(run.model.faces.size(), 0);
  run.patches.assign(run.model.faces.size(), std::nullopt);
  run.keeper.assign(run.model.faces.size(), no_process);
  place_narrow_patches(run);
  for (std::size_t f = 0; f < run.model.faces.size(); ++f)
    if (!run.domains.domain[f] && !run.domains.failure[f].empty() && !run.model.faces[f].discrete) run.fail(f, run.domains.failure[f]);
  if (!run.periodic.empty()) fail_partners(run);
  PatchJobs work{.run = run};
  work.left = run.options.max_triangles;
  // Narrow faces may be meshed twice in a round, and the spaces belong to the second mesh.
  if (run.options.crossing_rounds > 0 && run.narrow.empty() && run.options.executor.team == nullptr)
    run.known.begin(run.model.faces.size());
  else
    run.known.clear();
  make_jobs(work);
  if (run.options.executor.team != nullptr)
    mesh_in_team(work, *run.options.executor.team);
  else
    mesh_here(work);
  if (!run.periodic.empty()) carry_all(work);
  const bool none = std::all_of(run.keeper.begin(), run.keeper.end(), [](int rank) { return rank == no_process; });
  if (none && work.first_beyond_limit) throw LimitError(*work.first_beyond_limit);
}

}  // namespace carreau
