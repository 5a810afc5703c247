// SPDX-License-Identifier: BSD-3-Clause
// Meshes of a session that are made of known meshes: carried from another session, or refined.
#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "association/carry_mesh.h"
#include "cad/checked_cad.h"
#include "cad/part_cad.h"
#include "fields/part_monitor.h"
#include "high_order/raise_order.h"
#include "high_order/thresholds.h"
#include "model/format_point.h"
#include "pipeline/base/run.h"
#include "session/gluing.h"
#include "session/options.h"
#include "session/state.h"

namespace carreau {

namespace {

// The curves of the mesh are the curves of its model, and its faces have (u, v).
void require_faces_with_uv(const CompositeResult& result, const Meshed& meshed, const char* what) {
  std::string why;
  if (has_discrete(meshed.model))
    why = "faces are given by triangles";
  else if (result.mesh.independent)
    why = "the mesh is cross-patch: its triangles have no parameters of one face";
  else if (result.mesh.curves.size() != meshed.topology.curves.size())
    why = "cracks or narrow faces have changed its curves";
  if (!why.empty()) throw InvalidArgument(std::string("the mesh cannot be ") + what + ": " + why);
}

/// Hands on stops alone: the mesh may be discarded.
class TrialMonitor final : public Monitor {
 public:
  explicit TrialMonitor(Monitor& whole) : whole_(whole) {}
  void checkpoint() override { whole_.checkpoint(); }

 private:
  Monitor& whole_;
};

/// The model of a mesh, to evaluate it again. Keeps a reference to `meshed`.
struct KnownModel {
  explicit KnownModel(const Meshed& meshed)
      : whole(*meshed.cad), cad(whole, parts_of(meshed.model)), model{meshed.model, meshed.topology, meshed.supports.of_face, cad},
        rules(meshed.model, meshed.topology, cad, meshed.options.size) {}

  CheckedCad whole;
  PartCad cad;
  CurveModel model;
  SizeRules rules;
};

bool has_new_reasons(const SurfaceMesh& before, const SurfaceMesh& after) {
  return !std::equal(before.faces.begin(), before.faces.end(), after.faces.begin(), after.faces.end(),
                     [](const FaceMesh& p, const FaceMesh& q) { return p.why == q.why; });
}

}  // namespace

void Session::carry_mesh(const Session& from, MatchBy by) {
  State& s = *state_;
  const State& other = *from.state_;
  (void)from.mesh();
  const auto start = std::chrono::steady_clock::now();
  require_faces_with_uv(other.result, other.meshed, "carried");
  if (!s.cad) throw InvalidArgument("no geometry is registered: register the callbacks first");
  if (s.model.faces.empty()) throw InvalidModel("the model has no face");
  if (has_discrete(s.model)) throw InvalidModel("a mesh cannot be carried to faces that are given by triangles");
  s.projector.reset();
  s.tried_parameters = s.parameters, s.last_failed = true;
  PartMonitor run(s.monitor, 0, 1);
  run.progress(Phase::model, 0, 0);
  Model known = s.model;
  CheckedCad whole_cad(*s.cad), whole_before(*other.meshed.cad);
  PreparedModel prepared = prepare(known, whole_cad);
  prepared.options.element = other.meshed.options.element;
  PartCad cad(whole_cad, parts_of(prepared.model)), before(whole_before, parts_of(other.meshed.model));
  const CurveModel to{prepared.model, prepared.topology, prepared.supports.of_face, cad};
  const CurveModel of_mesh{other.meshed.model, other.meshed.topology, other.meshed.supports.of_face, before};
  const ModelMatch match = match_models(of_mesh, to, by);
  const SizeRules rules(prepared.model, prepared.topology, cad, prepared.options.size);
  CompositeResult result;
  const CarryReport report = carreau::carry_mesh({of_mesh, other.result}, to, match, rules, prepared.options, run, result);
  if (result.mesh.triangle_count() == 0 && result.mesh.loose_edge_count() == 0)
    throw DomainError("no face could be carried: triangles stay turned in each");
  constexpr const char* words[]{"", "references", "names", "shapes"};
  s.monitor.message(Level::summary, std::string("carried by ") + words[static_cast<int>(match.by)] + ": " + std::to_string(report.kept) +
                                        " faces with their (u, v), " + std::to_string(report.relaxed) + " relaxed, " + (report.smoothed > 0 ? std::to_string(report.smoothed) + " smoothed, " : "") + std::to_string(report.failed) + " failed");
  result.report.diag = prepared.supports.diag;
  result.report.calls = cad.counts();
  result.report.seconds_total = seconds_since(start);
  keep_result(std::move(prepared.model), std::move(prepared.supports), std::move(prepared.topology), std::move(prepared.options),
              std::move(result), nullptr, prepared.background, run);
  run.progress(Phase::idle, 0, 1);
}

void Session::refine_mesh(const RefineRequest& request) {
  State& s = *state_;
  (void)mesh();
  const auto start = std::chrono::steady_clock::now();
  require_faces_with_uv(s.result, s.meshed, "refined");
  PartMonitor run(s.monitor, 0, 1);
  const KnownModel known(s.meshed);
  CompositeResult result = s.result;
  carreau::refine_mesh(known.model, known.rules, s.meshed.options, request, run, result);
  result.report.calls = known.cad.counts();
  result.report.seconds_total = seconds_since(start);
  keep_refined(std::move(result), run);
  run.progress(Phase::idle, 0, 1);
}

void Session::keep_refined(CompositeResult result, Monitor& measuring) {
  State& s = *state_;
  result.crossings.clear(), result.report.crossings = -1;
  Meshed same = s.meshed;
  keep_result(std::move(same.model), std::move(same.supports), std::move(same.topology), std::move(same.options), std::move(result), nullptr, same.background,
              measuring);
}

const HighOrderMesh& Session::raised() const {
  if (!state_->raised) throw InvalidArgument("there are no elements of a higher order: make them first");
  return *state_->raised;
}
bool Session::has_raised() const noexcept { return state_->raised.has_value(); }

// An element between two edges of a curve that turn into each other is flat at their corner: an edge from it into the face parts them.
const HighOrderMesh& Session::raise_order(int order, NodePlaces places) {
  State& s = *state_;
  (void)mesh();
  require_faces_with_uv(s.result, s.meshed, "raised in order");
  PartMonitor run(s.monitor, 0, 1);
  const KnownModel known(s.meshed);
  HighOrderMesh made = carreau::raise_order(known.model, s.result, order, places, false, run);
  std::optional<CompositeResult> finer;
  TrialMonitor trial(run);
  for (int round = 0; round < thresholds::high_order::max_divisions && !made.invalid.empty() && s.result.mesh.periodic.empty(); ++round) {
    CompositeResult next = finer ? *finer : s.result;
    carreau::refine_mesh(known.model, known.rules, s.meshed.options, {.edges = made.coarse}, trial, next);
    if (has_new_reasons(s.result.mesh, next.mesh)) break;  // elements of order 2 have become invalid
    HighOrderMesh again = carreau::raise_order(known.model, next, order, places, false, run);
    if (again.invalid.size() >= made.invalid.size()) break;
    made = std::move(again), finer = std::move(next);
  }
  if (!made.invalid.empty()) made = carreau::raise_order(known.model, finer ? *finer : s.result, order, places, true, run);
  if (finer) keep_refined(std::move(*finer), run);
  made.names = names();
  show_points(s.meshed.model, made.corner_refs);
  if (!made.invalid.empty()) {
    const auto n = static_cast<std::size_t>(made.invalid.front());
    const std::size_t triangles = made.triangle_refs.size();
    const auto p = static_cast<std::size_t>(order);
    const std::int32_t corner = n < triangles ? made.triangles[n * (p + 1) * (p + 2) / 2] : made.quads[(n - triangles) * (p + 1) * (p + 1)];
    const int face = n < triangles ? made.triangle_refs[n] : made.quad_refs[n - triangles];
    s.monitor.message(Level::warning, Where{.face = face}.prefix() + std::to_string(made.invalid.size()) + (made.invalid.size() == 1 ? " element" : " elements") + " of order " +
                                          std::to_string(order) + (made.invalid.size() == 1 ? " is invalid, at " : " are invalid, the first one at ") + format_point(made.nodes[corner]));
  }
  s.raised = std::move(made);
  run.progress(Phase::idle, 0, 1);
  return *s.raised;
}

}  // namespace carreau
