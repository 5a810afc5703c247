// SPDX-License-Identifier: BSD-3-Clause
// The steps before the patches: gradation, curves, narrow faces, boundaries.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <span>

#include "curve/edge_accuracy.h"
#include "periodic/shared_curves.h"
#include "pipeline/base/run.h"
#include "pipeline/base/thresholds.h"
#include "support/stepped_tasks.h"
#include "surface/narrow/thin_bodies.h"

namespace carreau {

namespace {

using namespace thresholds::patches;

// `shared`: sizes of periodic curves, of all curves, or none.
void cut_curve(CompositeRun& run, std::size_t c, const std::vector<SizeSamples>& shared) {
  const SizeSamples* known = run.graded.curves.empty() ? nullptr : &run.graded.curves[c];
  if (!shared.empty() && run.periodic.has_class[c] != 0) known = &shared[c];
  run.curves[c] =
      discretise_curve(run.curve_model, static_cast<int>(c), run.rules, {.lss = run.options.lss, .known = known});
}

// Halves edges that are farther from their curve than the guarantee permits, or turned more. At a kink every edge
// exceeds the angle, so halvings end there.
void keep_to_curves(CompositeRun& run) {
  if (!run.options.size.geo_guarantee) return;
  const GeometricLimits limits = geometric_limits(run.options.size);
  if (!std::isfinite(limits.edge_angle_deg) && !std::isfinite(limits.deviation)) return;
  for (DiscreteCurve& curve : run.curves) {
    if (curve.indivisible) continue;
    run.monitor.checkpoint();
    const auto owner = static_cast<std::size_t>(curve.owner);
    const CurveUse& use = run.curve_model.curve(curve.curve).uses[owner];
    const auto is_off = [&](int k) {
      const std::array<Vec3, 2> ends{curve.xyz[k], curve.xyz[k + 1]};
      if (norm(ends[1] - ends[0]) <= limits.shortest_divided) return false;
      const std::vector<double>& t = curve.t_of_use[owner];
      const EdgeAccuracy found = edge_accuracy(run.cad, run.curve_model.face_ref(use), use.curve + 1, t[k], t[k + 1], ends);
      return found.angle_deg > limits.edge_angle_deg || found.deviation > limits.deviation;
    };
    for (int round = 0; round < max_curve_halvings; ++round) {
      bool any = false;
      for (int k = curve.segments() - 1; k >= 0; --k) {
        const bool off = is_off(k);
        if (off && curve.prescribed) run.report_kept(curve.curve, "geo_guarantee");
        any = (off && split_segment(curve, k, run.curve_model)) || any;
      }
      if (!any) break;
    }
  }
}

// False: all sides of narrow faces have been matched. The faces are indices in Model::faces.
bool mesh_as_others(CompositeRun& run, std::span<const int> unmatched) {
  if (unmatched.empty()) return false;
  for (const int f : unmatched)
    run.monitor.message(Level::detail, Where{.face = run.model.faces[f].ref}.prefix() +
                                           "the face is narrow, and places along its sides disagree: it is meshed as other faces are");
  leave_to_mesher(unmatched, run.narrow.strips);
  if (!run.narrow.vanishing.curve.empty()) let_end_caps_vanish(run.curve_model, run.narrow);
  return true;
}

// Matched sides have vertices at the same places. Vertices of prescribed edges may lie elsewhere.
bool keeps_prescribed(CompositeRun& run, int face) {
  for (const int c : run.topology.curve_of[face]) {
    if (!run.curves[c].prescribed) continue;
    run.report_kept(c, "narrow_faces");
    return true;
  }
  return false;
}

// Matched sides have other vertices than their images.
bool keeps_periodic(const CompositeRun& run, int face) {
  const std::vector<int>& curves = run.topology.curve_of[face];
  return !run.periodic.empty() && std::any_of(curves.begin(), curves.end(), [&](int c) { return run.periodic.has_class[c] != 0; });
}

}  // namespace

void grade_sizes(CompositeRun& run) {
  if (run.options.gradation == 0 || (run.rules.constant() && run.options.proximity == 0)) return;
  const auto start = std::chrono::steady_clock::now();
  run.monitor.progress(Phase::gradation, 0, 0);
  run.graded = grade_model(run.curve_model, run.rules, run.options, run.supports.diag, run.monitor, run.periodic);
  run.begin = ProgressShares::gradation;
  run.result.graded = run.graded.field;
  run.result.report.gradation_rounds = run.graded.rounds;
  run.result.report.gradation_triangles = run.graded.triangles;
  run.result.report.seconds_gradation = seconds_since(start);
}

void discretise_curves(CompositeRun& run) {
  const auto start = std::chrono::steady_clock::now();
  const std::size_t n = run.topology.curves.size();
  run.curves.resize(n);
  const std::vector<SizeSamples> shared = run.periodic.empty() ? std::vector<SizeSamples>{} : shared_sizes(run);
  // Rules keep the sizes of points for later, unless there is one size everywhere.
  const bool alone = !run.rules.constant() || !asks_from_threads(run.options, run.cad);
  const std::size_t at_once = alone ? 1 : 64;
  const std::int64_t most = run.options.max_triangles;
  std::int64_t edges = 0;
  for (std::size_t begin = 0; begin < n; begin += at_once) {
    const std::size_t end = std::min(begin + at_once, n);
    run.monitor.checkpoint();
    run.show_progress(Phase::curves, run.topology.curves[begin].ref,
             ProgressShares::curves * static_cast<double>(begin) / static_cast<double>(n));
    run_each(
        end - begin, alone, run.options.executor.threads, [&](std::size_t i, Monitor&) { cut_curve(run, begin + i, shared); },
        run.monitor);
    for (std::size_t c = begin; c < end; ++c) {
      edges += run.curves[c].segments();
      if (edges > most) refuse_triangles(Where{.curve = run.topology.curves[c].ref}, static_cast<double>(edges), most);
    }
  }
  place_rows_on_sides(run.layers, run.curve_model, run.curves);
  share_vertices(run.periodic, run.curve_model, run.curves);
  keep_to_curves(run);
  separate_coincident_curves(run.curve_model, run.curves);
  complete_classes(run.periodic, run.curve_model, run.curves);
  run.result.report.seconds_curves = seconds_since(start);
}

void find_narrow(CompositeRun& run) {
  NarrowModel& narrow = run.narrow;
  narrow.folded = find_folded_faces(run.curve_model, run.curves);
  if (run.options.narrow_faces == NarrowFaces::keep) return;
  const auto start = std::chrono::steady_clock::now();
  const bool collapse = run.options.narrow_faces == NarrowFaces::collapse;
  for (NarrowFace& face : find_narrow_faces(run.curve_model, run.curves, run.options.narrow_ratio)) {
    if (keeps_prescribed(run, face.face) || keeps_periodic(run, face.face)) continue;
    if (!face.point || collapse) (face.point ? narrow.points : narrow.strips).push_back(std::move(face));
  }
  if (collapse) keep_thin_bodies(run.curve_model, run.curves, narrow);
  if (!narrow.empty()) {
    if (collapse) let_end_caps_vanish(run.curve_model, narrow);
    mesh_as_others(run, match_sides(run.curve_model, narrow.strips, run.curves).unmatched);
  }
  run.result.report.seconds_curves += seconds_since(start);
}

namespace {

// Rows are low beside long edges of curves: faces with curves that have layers, or that rows may end at.
std::vector<char> faces_beside_rows(const CompositeRun& run) {
  std::vector<char> beside;
  if (run.layers.empty()) return beside;
  beside.resize(run.model.faces.size(), 0);
  const auto mark = [&](int c) {
    for (const CurveUse& use : run.topology.curves[c].uses) beside[use.face] = 1;
  };
  for (int c = 0; c < static_cast<int>(run.topology.curves.size()); ++c) {
    if (run.layers.of_curve(c) < 0) continue;
    mark(c);
    for (const int end : {run.topology.curves[c].end1, run.topology.curves[c].end2})
      for (const int side : run.topology.points[end].curves) mark(side);
  }
  return beside;
}

}  // namespace

void refine_boundaries(CompositeRun& run) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<char> beside_rows = faces_beside_rows(run);
  for (;;) {
    run.domains =
        refine_domains(run.curve_model, run.rules, run.options, run.limits(), run.narrow, run.curves, run.monitor, &run.periodic, beside_rows);
    if (mesh_as_others(run, run.domains.unmatched)) continue;
    run.between.clear();
    for (const NarrowFace& face : run.narrow.strips)
      run.between.push_back(mesh_between_sides(run.curve_model, face, run.curves));
    std::vector<NarrowFace> sound;
    for (std::size_t i = 0; i < run.between.size(); ++i)
      if (run.between[i].sound) sound.push_back(run.narrow.strips[i]);
    if (sound.size() == run.between.size() || !run.narrow.vanishing.curve.empty()) break;
    run.narrow.strips.swap(sound);
  }
  for (const int c : run.domains.kept)
    run.report_kept(c, "the checks of boundaries (edges that cross, are close or uneven)");
  run.result.report.seconds_curves += seconds_since(start);
}

}  // namespace carreau
