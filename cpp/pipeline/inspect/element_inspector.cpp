// SPDX-License-Identifier: BSD-3-Clause
// Elements other than straight triangles, made of the whole mesh.
#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "pipeline/base/inspector.h"
#include "pipeline/base/run.h"
#include "pipeline/base/thresholds.h"
#include "pipeline/inspect/crossing_requests.h"
#include "pipeline/inspect/face_triangle.h"
#include "support/format.h"
#include "support/infinity.h"
#include "surface/elements/second_order/quadratic.h"
#include "surface/elements/base/invalid_report.h"
#include "surface/elements/base/thresholds.h"
#include "surface/elements/quads/known_quads.h"
#include "surface/elements/quads/quadrilaterals.h"

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

QuadraticReport make_once(CompositeRun& run, KnownQuads* known) {
  const ElementWork work{run.curve_model, run.curves, run.rules, run.options, run.result, run.monitor,
                         run.periodic.empty() ? nullptr : &run.periodic,
                         run.layer_cells.empty() ? nullptr : &run.layer_cells, &run.layers};
  QuadraticReport report;
  if (has_quads(run.options.element)) report = make_quadrilaterals(work, known);
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
std::vector<std::pair<std::int32_t, int>> segments_of(const CompositeRun& run, std::vector<CurveEdge> coarse) {
  std::sort(coarse.begin(), coarse.end());
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

/// Triangles of the cells of rows, by face.
class RowCells {
 public:
  explicit RowCells(const CompositeRun& run) : run_(run), in_row_(run.layer_cells.size()) {
    for (std::size_t f = 0; f < in_row_.size(); ++f) {
      if (!run.layer_cells[f].empty()) in_row_[f].resize(run.result.mesh.faces[f].vertex.size(), 0);
      for (const LayerCell& cell : run.layer_cells[f])
        for (const std::int32_t v : cell.corners)
          if (v >= 0) in_row_[f][static_cast<std::size_t>(v)] = 1;
    }
  }
  /// All corners of the triangle belong to rows.
  [[nodiscard]] bool holds(std::pair<int, int> triangle) const {
    const auto f = static_cast<std::size_t>(triangle.first);
    if (f >= in_row_.size() || in_row_[f].empty()) return false;
    const auto& t = run_.result.mesh.faces[f].triangles[static_cast<std::size_t>(triangle.second)];
    return std::all_of(t.begin(), t.end(), [&](std::int32_t v) { return in_row_[f][static_cast<std::size_t>(v)] != 0; });
  }

 private:
  const CompositeRun& run_;
  std::vector<std::vector<char>> in_row_;  // by vertex
};

/// Collects requests for elements with faults. Rows that have a vertex of such an element retreat; elsewhere sizes fall.
class FaultRequests {
 public:
  FaultRequests(const CompositeRun& run, int divisor) : run_(run), divisor_(divisor) { requests_.sizes.resize(run.model.faces.size()); }

  void add(const InvalidElement& element) {
    std::vector<Vec3> corners;
    for (const EdgeSizes::Source& side : element.sides) corners.push_back(side.a);
    if (retreat(static_cast<int>(element.face), corners)) return;
    std::vector<EdgeSizes::Source>& sizes = requests_.sizes[element.face];
    sizes.insert(sizes.end(), element.sides.begin(), element.sides.end());
    coarse_.insert(coarse_.end(), element.coarse.begin(), element.coarse.end());
  }
  void add_turned() {
    for (std::size_t f = 0; f < run_.turned_at_rows.size(); ++f)
      for (const std::array<Vec3, 3>& corners : run_.turned_at_rows[f]) (void)retreat(static_cast<int>(f), corners);
  }
  // Smaller triangles part faces that are apart. Cells of rows are regular: if another triangle crosses one, it has the fault.
  void add(const Crossings& crossings, FacePairs& meeting, double budget) {
    const CurveEdges edges(crossings.mesh(), run_.curves);
    const CrossingRequests walls = find_requests(run_, crossings, meeting);
    add(plan_requests(run_, crossings, walls, budget), edges);
    FacePairs apart;
    for (const CrossingRequest& request : walls.requests) apart.insert(request.faces);
    const RowCells rows(run_);
    std::set<std::int32_t> faulty;
    for (const TriangleIntersection& pair : crossings.found.pairs) {
      if (apart.contains(std::minmax(crossings.origin(pair.triangles[0]).first, crossings.origin(pair.triangles[1]).first))) continue;
      const std::array<bool, 2> regular{rows.holds(crossings.origin(pair.triangles[0])), rows.holds(crossings.origin(pair.triangles[1]))};
      for (std::size_t k = 0; k < 2; ++k)
        if (!regular[k] || regular[1 - k]) faulty.insert(pair.triangles[k]);
    }
    for (const std::int32_t t : faulty) add(crossings, edges, t);
  }

  /// The requests, and the faces that they change.
  [[nodiscard]] RefinementRequests take(std::set<int>& faces) {
    requests_.segments = segments_of(run_, std::move(coarse_));
    for (const RowLimit& limit : requests_.rows) faces.insert(limit.face);
    for (std::size_t f = 0; f < requests_.sizes.size(); ++f)
      if (!requests_.sizes[f].empty()) faces.insert(static_cast<int>(f));
    for (const auto& [curve, segment] : requests_.segments)
      for (const CurveUse& use : run_.curve_model.curve(curve).uses) faces.insert(use.face);
    return std::move(requests_);
  }

 private:
  bool retreat(int face, std::span<const Vec3> corners) {
    const auto f = static_cast<std::size_t>(face);
    if (f >= run_.layer_cells.size() || run_.layer_cells[f].empty()) return false;
    const FaceMesh& mesh = run_.result.mesh.faces[f];
    return limit_rows_at(face, corners, divisor_, run_.layer_cells[f],
                         [&](std::int32_t v) { return run_.result.mesh.vertices[static_cast<std::size_t>(mesh.vertex[static_cast<std::size_t>(v)])]; },
                         has_quads_only(run_.options.element), requests_.rows);
  }

  // Sizes of cells that are cut are twice as large.
  void add(const RefinementPlan& plan, const CurveEdges& edges) {
    for (std::size_t f = 0; f < plan.sources.size(); ++f)
      for (EdgeSizes::Source source : plan.sources[f]) {
        source.h *= enlargement_for(run_.options.element);
        requests_.sizes[f].push_back(source);
      }
    for (const auto& [v, w] : plan.edges)
      if (const SegmentOfCurve* segment = edges.find(v, w)) coarse_.push_back({segment->curve, segment->segment});
  }

  void add(const Crossings& crossings, const CurveEdges& edges, std::int32_t t) {
    const std::array<std::int32_t, 3>& v = crossings.corners(t);
    std::array<Vec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = crossings.mesh().vertices[static_cast<std::size_t>(v[k])];
    const int face = crossings.origin(t).first;
    if (retreat(face, corners)) return;
    const std::vector<EdgeSizes::Source> sides = finer_sides(corners, infinity, run_.options.element);
    std::vector<EdgeSizes::Source>& sizes = requests_.sizes[static_cast<std::size_t>(face)];
    sizes.insert(sizes.end(), sides.begin(), sides.end());
    for (std::size_t k = 0; k < 3; ++k)
      if (const SegmentOfCurve* segment = edges.find(v[k], v[(k + 1) % 3])) coarse_.push_back({segment->curve, segment->segment});
  }

  const CompositeRun& run_;
  int divisor_;
  RefinementRequests requests_;
  std::vector<CurveEdge> coarse_;
};

class ElementInspector final : public Inspector {
 public:
  void inspect(CompositeRun& run) override {
    if (run.result.mesh.independent) return;  // it has its elements
    if (run.layers.empty())
      inspect_elements(run);
    else
      inspect_with_rows(run);
  }

  [[nodiscard]] bool is_better(const CompositeRun& /*run*/) const override { return faults_ < best_faults_; }
  void keep() override {
    best_ = now_, best_faults_ = faults_;
    kept_ = crossings_ ? crossings_->found : Intersections{};
  }

  [[nodiscard]] std::optional<RefinementRequests> requests(const CompositeRun& run) override {
    if (!run.options.refines_invalid_elements || faults_ == 0) return {};
    return run.layers.empty() ? finer(run) : retreat(run);
  }

  void report(CompositeRun& run) override {
    if (run.result.mesh.independent) return;
    if (run.may_lose_rows()) report_remarks(run);
    const bool straight = run.options.element == Element::p1;  // straight triangles cross elsewhere than other elements
    run.result.report.crossings = straight && run.options.crossing_rounds > 0 ? kept_.count : -1;
    run.result.crossings.clear();
    if (straight) run.result.crossings = std::move(kept_.pairs);
    report_invalid(run, best_);
  }

 private:
  void inspect_elements(CompositeRun& run) {
    now_ = make_once(run, nullptr);
    faults_ = static_cast<std::int64_t>(count(now_));
    const auto triangles = static_cast<double>(run.result.mesh.triangle_count());
    left_ = left_ ? *left_ - triangles : max_growth * std::max(few_triangles, triangles);
  }

  std::optional<RefinementRequests> finer(const CompositeRun& run) {
    if (round_++ == max_divisions || *left_ < 0) return {};
    FaultRequests collected(run, 0);
    for (const InvalidElement& element : now_.elements) collected.add(element);
    std::set<int> faces;
    return collected.take(faces);
  }

  // Nodes bend triangles of order 2: their straight triangles may cross.
  void inspect_with_rows(CompositeRun& run) {
    run.known.complete(run.result);
    if (run.options.element != Element::p1) {
      known_.begin(run.is_known);
      now_ = make_once(run, &known_);
      run.halved = has_quads_only(run.options.element);
    }
    crossings_.reset();
    if (run.options.crossing_rounds > 0 && run.options.element != Element::p2) crossings_.emplace(run);
    faults_ = static_cast<std::int64_t>(count(now_)) + (crossings_ ? crossings_->found.count : 0);
    for (const auto& turned : run.turned_at_rows) faults_ += std::ssize(turned);
    if (!left_) work_ = std::max(work_of_mesh(run), thresholds::crossings::min_budget);
    left_ = left_ ? *left_ - cost_ : run.options.rounds_over_first_mesh * work_;
  }

  // Rows lose half in the first round, and end in later rounds.
  std::optional<RefinementRequests> retreat(const CompositeRun& run) {
    FaultRequests collected(run, round_++ == 0 ? 2 : 0);
    for (const InvalidElement& element : now_.elements) collected.add(element);
    if (crossings_) collected.add(*crossings_, meeting_, *left_ / thresholds::crossings::work_of_varied_sizes);
    collected.add_turned();
    std::set<int> faces;
    RefinementRequests requests = collected.take(faces);
    const double share = thresholds::crossings::share_of_any_round;
    cost_ = share * work_ + (1 - share) * work_of_faces(run, faces);
    if (faces.empty() || cost_ > *left_) return {};
    return requests;
  }

  static void report_remarks(CompositeRun& run) {
    for (const auto& [f, what] : run.remarks) {
      const FaceStatus status = run.result.mesh.faces[f].status;
      if (status == FaceStatus::meshed || status == FaceStatus::mended) run.report(Level::warning, what);
    }
  }

  QuadraticReport now_, best_;
  std::int64_t faults_ = 0, best_faults_ = 0;
  int round_ = 0;
  // Triangles that finer meshes may have together; with layers, the work of rounds. Empty before the first mesh.
  std::optional<double> left_;
  // With layers:
  double work_ = 0, cost_ = 0;  // of the first mesh, of the next round
  KnownQuads known_;
  std::optional<Crossings> crossings_;
  FacePairs meeting_;
  Intersections kept_;
};

}  // namespace

std::unique_ptr<Inspector> make_element_inspector() { return std::make_unique<ElementInspector>(); }

}  // namespace carreau
