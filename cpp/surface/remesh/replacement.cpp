// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/replacement.h"

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

#include "mesh/crossings/changed_triangles.h"
#include "mesh/crossings/shared_search.h"
#include "mesh/flat_mesh.h"
#include "support/stepped_tasks.h"
#include "surface/assembly/whole_mesh.h"
#include "surface/remesh/base/thresholds.h"

namespace carreau {

namespace {

// Crossings aside.
std::string why_worse(const SurfaceMesh& made, const SurfaceMesh& before, int threads, Monitor& monitor) {
  std::vector<std::string> defects;
  std::array<std::int64_t, 2> numbers{};
  const std::array<std::function<void()>, 3> work{[&] { defects = find_defects(made, {.closed = false, .limit = 1}); },
                                                  [&] { numbers[0] = euler_number(made); }, [&] { numbers[1] = euler_number(before); }};
  run_each(work.size(), false, threads, [&](std::size_t k, Monitor&) { work[k](); }, monitor);
  if (!defects.empty() && find_defects(before, {.closed = false, .limit = 1}).empty()) return defects.front();
  return numbers[0] != numbers[1] ? "its Euler number would differ" : "";
}

}  // namespace

Replacement::Replacement(RemeshingFrame& frame, Cad& cad, const CompositeOptions& options, CompositeResult& result, Monitor& monitor)
    : frame_(frame),
      cad_(cad),
      options_(options),
      result_(result),
      monitor_(monitor),
      tolerances_(surface_tolerances(options, frame.charts->by_direction(), frame.angle_slack)),
      crossings_before_(result.report.crossings) {
  frame.workers = {options, cad};
}

std::vector<WorkedLine> Replacement::lines() const {
  std::vector<WorkedLine> worked;
  for (std::size_t k = 0; k < frame_.lines.size(); ++k) {
    worked.emplace_back(frame_.lines[k], frame_.geometry(frame_.lines[k]));
    worked.back().fixed = !frame_.twin.empty() && frame_.twin[k] >= 0;
  }
  return worked;
}

StartedMesh Replacement::start() const {
  return {std::make_unique<CrossPatchMesh>(result_.mesh, frame_.jets, result_.vertex_size, frame_.sharp, frame_.corners, tolerances_,
                                     *frame_.charts, cad_),
          lines()};
}

CrossPatchResult Replacement::assemble(StartedMesh& mesh) const {
  CellsInSpace cells{*mesh.free, *frame_.charts, cad_, {}, {}};
  for (const auto& t : mesh.free->triangles())
    if (t[0] >= 0) cells.cells.push_back({t[0], t[1], t[2], -1});
  CrossPatchResult made{reassemble(result_.mesh, cells, frame_.lines, mesh.worked, frame_.corners, frame_.workers, monitor_)};
  if (frame_.elements) made.free = std::move(mesh.free), made.worked = std::move(mesh.worked);
  return made;
}

// Pairs of triangles that stay are not searched again, if the crossings of the input mesh are known.
Intersections Replacement::find_crossings(const SurfaceMesh& mesh) {
  const FlatMesh flat = flatten(mesh, false);
  const std::int64_t limit = IntersectionOptions{}.limit;
  if (result_.report.crossings != static_cast<std::int64_t>(result_.crossings.size()))
    return find_intersections(flat.vertices, flat.triangles, limit, options_.executor, monitor_);
  std::vector<std::array<std::int32_t, 3>> triangles;  // as their numbers in the pairs are
  triangles.reserve(result_.mesh.triangle_count());
  for (const FaceMesh& face : result_.mesh.faces)
    for (const auto& [a, b, c] : face.triangles) triangles.push_back({face.vertex[a], face.vertex[b], face.vertex[c]});
  return find_intersections_again({result_.mesh.vertices, triangles, result_.crossings}, flat.vertices, flat.triangles, limit,
                                  options_.executor, monitor_);
}

std::int64_t Replacement::crossings_before() {
  if (crossings_before_ < 0) crossings_before_ = find_crossings(result_.mesh).count;
  return crossings_before_;
}

Candidate Replacement::judge(StartedMesh& mesh) {
  Candidate candidate{assemble(mesh), {}, "", false};
  candidate.crossings = find_crossings(candidate.made.mesh);
  candidate.crosses = candidate.crossings.count > 0 && candidate.crossings.count > crossings_before();
  candidate.why = candidate.crosses ? "more triangles would cross"
                                    : why_worse(candidate.made.mesh, result_.mesh, options_.executor.threads, monitor_);
  return candidate;
}

void Replacement::guard(const Candidate& candidate) {
  const FlatMesh flat = flatten(candidate.made.mesh, false);
  for (const TriangleIntersection& pair : candidate.crossings.pairs)
    frame_.charts->guard(pair.place, thresholds::remesh::guarded_sizes *
                                         candidate.made.vertex_size[flat.triangles[pair.triangles[0]][0]]);
}

void Replacement::accept(Candidate&& candidate) {
  if (result_.report.crossings >= 0)
    result_.report.crossings = candidate.crossings.count, result_.crossings = std::move(candidate.crossings.pairs);
  if (frame_.elements) result_.report.crossings = -1, result_.crossings.clear();  // elements cross elsewhere
  take(std::move(candidate.made));
}

void Replacement::accept_as_it_is(StartedMesh&& mesh) { take(assemble(mesh)); }

void Replacement::take(CrossPatchResult&& made) {
  if (frame_.elements) frame_.elements(result_.mesh, made);
  for (std::size_t f = 0; f < made.mesh.faces.size(); ++f)
    if (made.mesh.faces[f].status != result_.mesh.faces[f].status) monitor_.message(Level::warning, made.mesh.faces[f].why);
  static_cast<SizedMesh&>(result_) = std::move(made);
  result_.atlas = std::move(frame_.charts);
}

}  // namespace carreau
