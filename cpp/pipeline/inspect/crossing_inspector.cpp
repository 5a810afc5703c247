// SPDX-License-Identifier: BSD-3-Clause
// Triangles of faces that are close to each other: chords that cross although the surfaces do not.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "pipeline/base/inspector.h"
#include "pipeline/base/run.h"
#include "pipeline/base/thresholds.h"
#include "pipeline/inspect/crossing_requests.h"

namespace carreau {

namespace {

using namespace thresholds::crossings;

// Edges of curves that the plan halves. A curve that has vanished has none.
std::vector<std::pair<std::int32_t, int>> segments_of(const CompositeRun& run, const RefinementPlan& plan) {
  std::vector<std::pair<std::int32_t, int>> segments;
  for (std::size_t c = 0; c < run.cut_curves.size(); ++c) {
    const std::vector<std::int32_t>& v = run.result.mesh.curves[c].vertices;
    const int n = run.cut_curves[c].segments();
    if (std::ssize(v) != n + 1) continue;
    for (int k = 0; k < n; ++k)
      if (plan.edges.contains(std::minmax(v[k], v[k + 1]))) segments.emplace_back(static_cast<std::int32_t>(c), k);
  }
  return segments;
}

// The pairs of triangles of an earlier mesh, without pairs of faces that were found to meet since.
std::int64_t avoidable(const CrossingRequests& earlier, const FacePairs& meeting) {
  std::int64_t pairs = 0;
  for (const CrossingRequest& request : earlier.requests)
    if (!meeting.contains(request.faces)) pairs += request.pairs;
  return pairs;
}

// The faces of a plane domain lie beside one another, and the triangles of each have equal orientation.
bool covers_a_plane_once(const CompositeRun& run) {
  const std::vector<FaceMesh>& faces = run.result.mesh.faces;
  return run.model.plane && std::all_of(faces.begin(), faces.end(),
                                        [](const FaceMesh& face) { return face.status == FaceStatus::meshed; });
}

class CrossingInspector final : public Inspector {
 public:
  void inspect(CompositeRun& run) override {
    if (covers_a_plane_once(run)) return;
    if (!now_)
      budget_ = run.options.rounds_over_first_mesh * std::max(work_of_mesh(run), min_budget) / work_of_varied_sizes;
    else
      budget_ -= work_of_faces(run, plan_.faces);
    now_.emplace(run);
    requests_ = find_requests(run, *now_, meeting_);
  }

  [[nodiscard]] bool is_better(const CompositeRun& /*run*/) const override {
    return requests_.avoidable < avoidable(fewest_, meeting_);
  }

  void keep() override {
    fewest_ = requests_;
    if (now_) kept_ = now_->found;
  }

  // The plan bounds the expected work; the number of triangles bounds the real work.
  [[nodiscard]] std::optional<RefinementRequests> requests(const CompositeRun& run) override {
    if (!now_ || round_++ == run.options.crossing_rounds || requests_.avoidable == 0) return {};
    plan_ = plan_requests(run, *now_, requests_, budget_);
    if (plan_.empty()) return {};
    return RefinementRequests{.segments = segments_of(run, plan_),
                              .sizes = plan_.sources,
                              .max_triangles = static_cast<std::int64_t>(work_of_mesh(run) + budget_)};
  }

  void report(CompositeRun& run) override {
    run.result.report.crossings = kept_.count;
    // No process can number the triangles of a mesh in parts.
    if (!run.options.parts) run.result.crossings = std::move(kept_.pairs);
  }

 private:
  std::optional<Crossings> now_;  // empty: the faces cannot cross
  Intersections kept_;
  FacePairs meeting_;
  CrossingRequests requests_, fewest_;
  RefinementPlan plan_;
  double budget_ = 0;
  int round_ = 0;
};

}  // namespace

std::unique_ptr<Inspector> make_crossing_inspector() { return std::make_unique<CrossingInspector>(); }

}  // namespace carreau
