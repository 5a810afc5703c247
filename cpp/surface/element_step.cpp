// SPDX-License-Identifier: BSD-3-Clause
// Elements other than straight triangles, made of the whole mesh.
#include <algorithm>
#include <utility>

#include "support/format.h"
#include "surface/attempts.h"
#include "surface/elements/quadratic.h"
#include "surface/elements/thresholds.h"
#include "surface/quads/quadrilaterals.h"
#include "surface/run.h"

namespace carreau {

namespace {

using namespace thresholds::elements;

bool part_invalid_quads(const QuadraticReport& report, SurfaceMesh& mesh) {
  bool any = false;
  for (std::size_t f = 0; f < report.quads.size(); ++f) {
    if (report.quads[f].empty()) continue;
    part_quads(mesh.faces[f], report.quads[f]);
    any = true;
  }
  return any;
}

QuadraticReport make_once(CompositeRun& run) {
  const ElementWork work{run.curve_model, run.curves, run.rules, run.options, run.result, run.monitor};
  QuadraticReport report;
  if (has_quads(run.options.element)) report = make_quadrilaterals(work);
  if (!is_quadratic(run.options.element)) return report;
  report = make_quadratic(work);
  const std::vector<CuspEnd> cusps = report.cusps;
  if (!cusps.empty()) report = make_quadratic(work, cusps);
  // A few triangles are allowed: two stand for a quadrilateral that cannot be valid.
  for (int round = 0; round < most_partings && run.options.element == Element::q2_0; ++round) {
    if (!part_invalid_quads(report, run.result.mesh)) break;
    report = make_quadratic(work, cusps);
  }
  return report;
}

std::size_t count(const QuadraticReport& report) {
  std::size_t sum = 0;
  for (const InvalidElements& invalid : report.invalid) sum += invalid.count;
  return sum;
}

// Smaller elements inside faces, too.
void divide_faces(CompositeRun& run, const QuadraticReport& report) {
  run.finer.resize(report.finer.size());
  for (std::size_t f = 0; f < report.finer.size(); ++f)
    run.finer[f].insert(run.finer[f].end(), report.finer[f].begin(), report.finer[f].end());
}

// Quadrilaterals may have divided the edges of curves: those before are meant.
void divide_curves(CompositeRun& run, const std::vector<CurveEdge>& coarse) {
  std::vector<std::pair<std::int32_t, int>> segments;
  for (const CurveEdge& edge : coarse) {
    if (edge.curve >= std::ssize(run.cut_curves)) continue;  // what a vanished face has left
    const int before = run.cut_curves[edge.curve].segments(), now = run.curves[edge.curve].segments();
    segments.emplace_back(edge.curve, static_cast<int>(std::int64_t{edge.segment} * before / now));
  }
  segments.erase(std::unique(segments.begin(), segments.end()), segments.end());
  divide_segments(run, segments);
}

void tell(CompositeRun& run, const QuadraticReport& report) {
  for (const InvalidElements& invalid : report.invalid) {
    FaceMesh& face = run.result.mesh.faces[invalid.face];
    const std::string what =
        Where{.face = face.ref, .uv = invalid.uv}.prefix() + std::to_string(invalid.count) +
        (invalid.count == 1 ? " element has" : " elements have") +
        " a Jacobian that is not positive everywhere";
    face.status = FaceStatus::mended;
    face.why += (face.why.empty() ? "" : "; ") + what;
    run.say(Level::warning, what);
  }
}

}  // namespace

void divide_segments(CompositeRun& run, const std::vector<std::pair<std::int32_t, int>>& coarse) {
  std::vector<DiscreteCurve> curves = run.cut_curves;
  for (auto edge = coarse.rbegin(); edge != coarse.rend(); ++edge)
    (void)split_segment(curves[edge->first], edge->second, run.curve_model);
  run.curves = std::move(curves);
  if (!run.narrow.strips.empty()) complete_sides(run.curve_model, run.narrow.strips, run.curves);
}

void make_elements(CompositeRun& run, const std::function<void()>& mesh_again) {
  if (run.options.element == Element::p1) return;
  QuadraticReport now = make_once(run), best = now;
  Attempts attempts(run, mesh_again);
  double left = most_growth * std::max(few_triangles, static_cast<double>(run.result.mesh.triangle_count()));
  const int rounds = has_quads(run.options.element) ? most_divisions_of_quads : most_divisions;
  for (int round = 0; round < rounds && count(now) > 0 && left >= 0; ++round) {
    if (!attempts.again([&] { divide_curves(run, now.coarse), divide_faces(run, now); })) break;
    now = make_once(run);
    left -= static_cast<double>(run.result.mesh.triangle_count());
    if (attempts.keep_if(count(now) < count(best))) best = now;
  }
  attempts.finish();
  run.result.report.crossings = -1;  // those of straight triangles say nothing of these
  run.result.crossings.clear();
  tell(run, best);
}

}  // namespace carreau
