// SPDX-License-Identifier: BSD-3-Clause
// Triangles of faces that are close to each other: chords that cross although the surfaces do not.
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "surface/attempts.h"
#include "surface/crossings/crossing_requests.h"
#include "surface/run.h"
#include "surface/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::crossings;

void split_curves(const CompositeRun& run, const RefinementPlan& plan, std::vector<DiscreteCurve>& curves) {
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const std::vector<std::int32_t>& v = run.result.mesh.curves[c].vertices;
    if (static_cast<int>(v.size()) != curves[c].segments() + 1) continue;  // it has vanished
    for (int k = curves[c].segments() - 1; k >= 0; --k) {
      const auto i = static_cast<std::size_t>(k);
      if (plan.edges.contains(std::minmax(v[i], v[i + 1]))) split_segment(curves[c], k, run.curve_model);
    }
  }
  if (!run.narrow.strips.empty()) complete_sides(run.curve_model, run.narrow.strips, curves);
}

// The plan bounds the work as it was expected; the number of triangles bounds the work that is done.
void make_finer(CompositeRun& run, const RefinementPlan& plan, std::int64_t most_triangles) {
  run.options.max_triangles = most_triangles;
  run.curves = run.cut_curves;
  split_curves(run, plan, run.curves);
  run.finer.resize(plan.sources.size());
  for (std::size_t f = 0; f < plan.sources.size(); ++f)
    run.finer[f].insert(run.finer[f].end(), plan.sources[f].begin(), plan.sources[f].end());
}

// The pairs of triangles of an earlier mesh, without those of faces that were found to meet since.
std::int64_t avoidable(const CrossingRequests& earlier, const FacePairs& meeting) {
  std::int64_t pairs = 0;
  for (const CrossingRequest& request : earlier.requests)
    if (!meeting.contains(request.faces)) pairs += request.pairs;
  return pairs;
}

// The faces of a plane domain lie beside one another, and the triangles of each are turned the same way.
bool covers_a_plane_once(const CompositeRun& run) {
  const std::vector<FaceMesh>& faces = run.result.mesh.faces;
  return run.model.plane && std::all_of(faces.begin(), faces.end(),
                                        [](const FaceMesh& face) { return face.status == FaceStatus::meshed; });
}

}  // namespace

void part_crossing_triangles(CompositeRun& run, const std::function<void()>& mesh_again) {
  if (run.options.crossing_rounds == 0) return;
  if (covers_a_plane_once(run)) {
    run.result.report.crossings = 0;
    return;
  }
  Crossings now(run);
  Intersections kept = now.found;
  FacePairs meeting;
  CrossingRequests requests = find_requests(run, now, meeting);
  CrossingRequests fewest = requests;
  Attempts attempts(run, mesh_again);
  const std::int64_t allowed = run.options.max_triangles;
  double budget = std::max(work_of_mesh(run), least_budget) / work_of_varied_sizes;
  for (int round = 0; round < run.options.crossing_rounds && requests.avoidable > 0; ++round) {
    const RefinementPlan plan = plan_requests(run, now, requests, budget);
    if (plan.empty()) break;
    const auto most = static_cast<std::int64_t>(work_of_mesh(run) + budget);
    if (!attempts.again([&] { make_finer(run, plan, std::min(allowed, most)); })) break;
    budget -= work_of_faces(run, plan.faces);
    now = Crossings(run);
    requests = find_requests(run, now, meeting);
    if (!attempts.keep_if(requests.avoidable < avoidable(fewest, meeting))) continue;
    fewest = requests;
    kept = now.found;
  }
  attempts.finish();
  run.options.max_triangles = allowed;
  run.result.report.crossings = kept.count;
  // No process can number the triangles of a mesh in parts.
  if (!run.options.parts) run.result.crossings = std::move(kept.pairs);
}

}  // namespace carreau
