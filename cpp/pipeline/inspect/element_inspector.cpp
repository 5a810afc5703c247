// SPDX-License-Identifier: BSD-3-Clause
// Elements other than straight triangles, made of the whole mesh.
#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "pipeline/base/inspector.h"
#include "pipeline/base/run.h"
#include "pipeline/inspect/crossing_requests.h"
#include "support/format.h"
#include "surface/elements/second_order/quadratic.h"
#include "surface/elements/base/invalid_report.h"
#include "surface/elements/base/thresholds.h"
#include "surface/elements/quads/quadrilaterals.h"

namespace carreau {

namespace {

using namespace thresholds::elements;

/// Rounds in which rows lose half of their height: 40 rows end.
constexpr int max_retreats = 12;

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
  const ElementWork work{run.curve_model, run.curves, run.rules, run.options, run.result, run.monitor,
                         run.periodic.empty() ? nullptr : &run.periodic,
                         run.layer_cells.empty() ? nullptr : &run.layer_cells, &run.layers};
  QuadraticReport report;
  if (has_quads(run.options.element)) report = make_quadrilaterals(work);
  if (!is_quadratic(run.options.element)) return report;
  report = make_quadratic(work);
  const std::vector<CuspEnd> cusps = report.cusps;
  if (!cusps.empty()) report = make_quadratic(work, cusps);
  // A few triangles are allowed: two replace a quadrilateral that cannot be valid.
  for (int round = 0; round < max_partings && run.options.element == Element::q2_0; ++round) {
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

// Quadrilaterals may have divided the edges of curves: the edges before are meant.
std::vector<std::pair<std::int32_t, int>> segments_of(const CompositeRun& run, const std::vector<CurveEdge>& coarse) {
  std::vector<std::pair<std::int32_t, int>> segments;
  for (const CurveEdge& edge : coarse) {
    if (edge.curve >= std::ssize(run.cut_curves)) continue;  // a vanished face has left it
    const int before = run.cut_curves[edge.curve].segments(), now = run.curves[edge.curve].segments();
    segments.emplace_back(edge.curve, static_cast<int>(std::int64_t{edge.segment} * before / now));
  }
  segments.erase(std::unique(segments.begin(), segments.end()), segments.end());
  return segments;
}

void report_invalid(CompositeRun& run, const QuadraticReport& report) {
  for (const InvalidElements& invalid : report.invalid)
    run.report(Level::warning, mark_invalid(run.result.mesh.faces[invalid.face], invalid.uv, invalid.count));
}

class ElementInspector : public Inspector {
 public:
  void inspect(CompositeRun& run) override {
    if (run.result.mesh.independent) return;  // it has its elements
    now_ = make_once(run);
    const auto triangles = static_cast<double>(run.result.mesh.triangle_count());
    if (!left_)
      left_ = max_growth * std::max(few_triangles, triangles);
    else
      *left_ -= triangles;
  }

  [[nodiscard]] bool is_better(const CompositeRun& /*run*/) const override { return count(now_) < count(best_); }
  void keep() override { best_ = now_; }

  [[nodiscard]] std::optional<RefinementRequests> requests(const CompositeRun& run) override {
    if (!run.options.refines_invalid_elements) return {};
    const int rounds = max_divisions;
    if (round_++ == rounds || count(now_) == 0 || *left_ < 0) return {};
    return RefinementRequests{.segments = segments_of(run, now_.coarse), .sizes = now_.finer};
  }

  void report(CompositeRun& run) override {
    if (run.result.mesh.independent) return;
    run.result.report.crossings = -1;  // straight triangles cross elsewhere than these elements
    run.result.crossings.clear();
    report_invalid(run, best_);
  }

 protected:
  [[nodiscard]] const QuadraticReport& now() const { return now_; }

 private:
  QuadraticReport now_, best_;
  std::optional<double> left_;  // triangles that finer meshes may have together; empty before the first mesh
  int round_ = 0;
};

// Rows retreat beside elements that are invalid, and beside triangles that cross. Nodes bend elements of order 2: their straight
// triangles may cross.
class RowInspector final : public ElementInspector {
 public:
  void inspect(CompositeRun& run) override {
    if (run.options.element != Element::p1) ElementInspector::inspect(run);
    crossings_ = {};
    if (run.options.crossing_rounds == 0 || run.options.element == Element::p2) return;
    const Crossings crossings(run);
    crossings_ = crossings.found;
    limits_.clear();
    for (const TriangleIntersection& pair : crossings_.pairs)
      for (const std::int32_t t : pair.triangles) {
        const auto& [a, b, c] = crossings.corners(t);
        const std::vector<Vec3>& at = crossings.mesh().vertices;
        const double longest = std::max({norm(at[b] - at[a]), norm(at[c] - at[b]), norm(at[a] - at[c])});
        retreat(run, crossings.origin(t).first, pair.place, longest);
      }
  }

  [[nodiscard]] bool is_better(const CompositeRun& run) const override {
    return faults() < best_ || (run.options.element != Element::p1 && faults() == best_ && ElementInspector::is_better(run));
  }
  void keep() override { best_ = faults(), ElementInspector::keep(); }

  [[nodiscard]] std::optional<RefinementRequests> requests(const CompositeRun& run) override {
    if (round_ < max_retreats && faults() > 0) {
      std::vector<RowLimit> limits = std::exchange(limits_, {});
      for (std::size_t f = 0; f < now().finer.size(); ++f)
        for (const EdgeSizes::Source& side : now().finer[f]) retreat(run, static_cast<int>(f), 0.5 * (side.a + side.b), norm(side.b - side.a));
      limits.insert(limits.end(), limits_.begin(), limits_.end());
      limits_.clear();
      ++round_;
      if (!limits.empty()) return RefinementRequests{.rows = std::move(limits)};
    }
    if (run.options.element == Element::p1) return {};
    return ElementInspector::requests(run);
  }

  void report(CompositeRun& run) override {
    if (run.options.element != Element::p1) ElementInspector::report(run);
  }

 private:
  [[nodiscard]] std::int64_t faults() const { return crossings_.count + static_cast<std::int64_t>(count(now())); }

  void retreat(const CompositeRun& run, int face, const Vec3& place, double reach) {
    if (static_cast<std::size_t>(face) >= run.layer_cells.size()) return;
    const FaceMesh& mesh = run.result.mesh.faces[static_cast<std::size_t>(face)];
    halve_rows_near(face, place, reach, run.layer_cells[static_cast<std::size_t>(face)],
                    [&](std::int32_t v) { return run.result.mesh.vertices[mesh.vertex[v]]; }, has_quads_only(run.options.element), limits_);
  }

  Intersections crossings_;
  std::vector<RowLimit> limits_;
  std::int64_t best_ = 0;
  int round_ = 0;
};

}  // namespace

std::unique_ptr<Inspector> make_row_inspector() { return std::make_unique<RowInspector>(); }

std::unique_ptr<Inspector> make_element_inspector() { return std::make_unique<ElementInspector>(); }

}  // namespace carreau
