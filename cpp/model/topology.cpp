// SPDX-License-Identifier: BSD-3-Clause
#include "model/topology.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "model/places.h"
#include "model/traces.h"
#include "model/union_find.h"
#include "support/error.h"
#include "support/format.h"
#include "support/infinity.h"

namespace carreau {

namespace {

// A trace within this share of the tolerance is one point, whatever its references are.
constexpr double point_share = 1e-3;
// A loop that is no larger than that would vanish: there, within this share of its longest side.
constexpr double point_share_of_loop = 1e-3;
// Rounding of coordinates has no loops.
constexpr double loop_rounding = 1e-7;
// Fractions of the length at which closed curves are compared: more than a symmetric shape can hide.
constexpr int probes = 23;

class TopologyBuilder {
 public:
  TopologyBuilder(const Model& model, const CurveTraces& traces, double eps, double eps_match)
      : model_(model), traces_(traces), eps_(eps), apart_(std::max(eps, eps_match)), corners_(prepare_corners()) {}

  Topology run() {
    find_small_loops();
    merge_ends_of_points();
    for (std::size_t f = 0; f < model_.faces.size(); ++f) {
      topology_.curve_of.emplace_back();
      for (std::size_t c = 0; c < model_.faces[f].curves.size(); ++c) add_use(static_cast<int>(f), static_cast<int>(c));
    }
    collect_curves_of_points();
    return std::move(topology_);
  }

  /// Describes the places that are farther apart than eps; "": none.
  [[nodiscard]] std::string remark() const {
    if (wide_ == 0) return "";
    return std::to_string(wide_) + (wide_ == 1 ? " curve or end of one is" : " curves or ends of them are") +
           " up to " + format_number(widest_) + " away from where another face has them (first " + widest_place_ +
           "); the mesh joins them, since " +
           (apart_ < infinity ? "eps_match is " + format_number(apart_)
                              : "the file gives them one reference; eps_match rejects gaps above its value");
  }

 private:
  [[nodiscard]] const FaceCurve& face_curve(const CurveUse& use) const {
    return model_.faces[use.face].curves[use.curve];
  }
  [[nodiscard]] std::span<const Vec3> trace(const CurveUse& use) const { return traces_[use.face][use.curve]; }
  [[nodiscard]] Where where(const CurveUse& use) const { return place_of(model_, use.face, use.curve); }
  [[nodiscard]] std::string name(const CurveUse& use) const {
    return "curve " + std::to_string(use.curve + 1) + " of face " + std::to_string(model_.faces[use.face].ref) +
           of_line(face_curve(use).line);
  }

  template <typename Visit>
  void for_each_curve(Visit visit) const {
    for (std::size_t f = 0; f < model_.faces.size(); ++f)
      for (std::size_t c = 0; c < model_.faces[f].curves.size(); ++c)
        visit(model_.faces[f].curves[c], std::span<const Vec3>(traces_[f][c]));
  }

  UnionFind prepare_corners() {
    for_each_curve([&](const FaceCurve& curve, std::span<const Vec3>) {
      rank_.try_emplace(curve.end1, rank_.size());
      rank_.try_emplace(curve.end2, rank_.size());
    });
    slack_.assign(rank_.size(), 0);
    return UnionFind(rank_.size());
  }

  // The sides of a small hole or boss are no points, for no face that uses them: a loop of such sides would vanish.
  // This also holds for the end of a wire a hundred thousand times longer than thick.
  void find_small_loops() {
    for (std::size_t f = 0; f < model_.faces.size(); ++f) {
      const std::vector<FaceCurve>& curves = model_.faces[f].curves;
      const auto is_tiny = [&](double extent) {
        return extent <= point_share * eps_ && extent > loop_rounding * eps_;
      };
      if (std::none_of(traces_[f].begin(), traces_[f].end(),
                       [&](const auto& points) { return is_tiny(trace_extent(points)); }))
        continue;
      UnionFind loops(rank_.size());
      std::map<std::size_t, double> longest;
      for (const FaceCurve& curve : curves) loops.merge(rank_[curve.end1], rank_[curve.end2]);
      for (std::size_t c = 0; c < curves.size(); ++c) {
        double& extent = longest.try_emplace(loops.find(rank_[curves[c].end1]), 0).first->second;
        extent = std::max(extent, trace_extent(traces_[f][c]));
      }
      for (const FaceCurve& curve : curves) {
        const double extent = longest[loops.find(rank_[curve.end1])];
        if (curve.type != CurveType::boundary || !is_tiny(extent)) continue;
        double& bound = point_extent_.try_emplace(curve.ref, infinity).first->second;
        bound = std::min(bound, point_share_of_loop * extent);
      }
    }
  }

  // The manual required two references even for a side that is one point: they are one corner. Ends of collapsed curves
  // may be as far from their corner as the curves were long.
  void merge_ends_of_points() {
    for_each_curve([&](const FaceCurve& curve, std::span<const Vec3> points) {
      if (curve.collapsed || is_point(curve.ref, points)) corners_.merge(rank_[curve.end1], rank_[curve.end2]);
    });
    for_each_curve([&](const FaceCurve& curve, std::span<const Vec3> points) {
      if (curve.collapsed) slack_[corners_.find(rank_[curve.end1])] += trace_length(points);
    });
  }

  [[nodiscard]] bool is_point(int ref, std::span<const Vec3> points) const {
    const auto of_small_loop = point_extent_.find(ref);
    const double bound = of_small_loop == point_extent_.end() ? infinity : of_small_loop->second;
    return trace_extent(points) <= std::min(point_share * eps_, bound);
  }

  // A small curve whose ends were glued together is a point too, but a small closed curve bounds a small hole.
  [[nodiscard]] bool is_degenerate(const CurveUse& use, bool one_end) const {
    const std::span<const Vec3> points = trace(use);
    const double extent = trace_extent(points), gap = norm(points.back() - points.front());
    return face_curve(use).collapsed || is_point(face_curve(use).ref, points) ||
           (one_end && extent <= eps_ && gap > 0.1 * extent);
  }

  int corner(int ref, Vec3 position) {
    const std::size_t set = corners_.find(rank_[ref]);
    const auto [it, added] = index_of_corner_.try_emplace(set, static_cast<int>(topology_.points.size()));
    if (added) {
      topology_.points.push_back({ref, position, {}});
      slack_of_point_.push_back(slack_[set]);
    }
    return it->second;
  }

  void add_use(int f, int c) {
    CurveUse use{f, c, false};
    const FaceCurve& curve = face_curve(use);
    const int end1 = corner(curve.end1, trace(use).front()), end2 = corner(curve.end2, trace(use).back());
    const bool point = is_degenerate(use, end1 == end2);
    check_ends(use, end1, end2);
    const auto [it, first] = curve_of_ref_.try_emplace(curve.ref, static_cast<int>(topology_.curves.size()));
    topology_.curve_of[f].push_back(it->second);
    if (first) {
      topology_.curves.push_back({curve.ref, {use}, end1, end2, point});
      return;
    }
    Curve& shape = topology_.curves[it->second];
    const bool same = end1 == shape.end1 && end2 == shape.end2, against = end1 == shape.end2 && end2 == shape.end1;
    if (!same && !against)
      throw InvalidModel(where(use),
                         "its ends differ from the ends of " + name(shape.uses.front()) + ", which has the same reference");
    if (!curve.collapsed) check_gap(shape, use);
    if (shape.degenerate != point)
      throw InvalidModel(
          where(use), std::string("the curve is ") + (point ? "one point of space, but " : "no point, but ") +
                          name(shape.uses.front()) + ", which has the same reference, is " + (point ? "not" : "one"));
    use.reversed = same && against ? !point && runs_against(shape, use) : against;
    shape.uses.push_back(use);
  }

  // Each end must be at the first place of its reference.
  void check_ends(const CurveUse& use, int end1, int end2) {
    const Vec3 front = trace(use).front(), back = trace(use).back();
    const Vec3 p1 = topology_.points[end1].position, p2 = topology_.points[end2].position;
    const double gap1 = norm(front - p1), gap2 = norm(back - p2), gap = std::max(gap1, gap2);
    const double swapped = std::max(norm(front - p2), norm(back - p1));
    if (gap > point_share * eps_ && swapped < 0.1 * gap)
      throw InvalidModel(where(use), "refp1 and refp2 are exchanged: its first end is at the point of reference " +
                                         std::to_string(face_curve(use).end2) + ", its second end at the point of reference " +
                                         std::to_string(face_curve(use).end1));
    const bool first = gap1 - slack_of_point_[end1] > apart_;
    if (!first && gap2 - slack_of_point_[end2] <= apart_) {
      note_gap(use, std::max(gap1 - slack_of_point_[end1], gap2 - slack_of_point_[end2]));
      return;
    }
    if (face_curve(use).end1 == face_curve(use).end2 && norm(back - front) > apart_)
      throw InvalidModel(where(use), "refp1 and refp2 are both " + std::to_string(face_curve(use).end1) +
                                         ", but the ends of the curve are " + format_number(norm(back - front)) +
                                         " apart, and " + format_number(gap) + " from where that point is");
    throw InvalidModel(where(use), std::string("its ") + (first ? "first" : "second") + " end is " +
                                       format_number(first ? gap1 : gap2) + " away from the point of reference " +
                                       std::to_string(first ? face_curve(use).end1 : face_curve(use).end2) +
                                       ", as another curve gave it before (tolerance " + format_number(apart_) + ")");
  }

  // Farther apart than usual, and joined nevertheless.
  void note_gap(const CurveUse& use, double gap) {
    if (gap <= eps_) return;
    ++wide_;
    if (gap <= widest_) return;
    widest_ = gap;
    widest_place_ = "face " + std::to_string(model_.faces[use.face].ref) + ", curve " + std::to_string(use.curve + 1);
  }

  void check_gap(const Curve& shape, const CurveUse& use) {
    const std::span<const Vec3> first = trace(shape.uses.front()), other = trace(use);
    if (hausdorff_distance(first, other, eps_, eps_) <= eps_) return;
    if (const double gap = apart_ > eps_ ? hausdorff_distance(first, other, infinity) : infinity; gap <= apart_) {
      note_gap(use, gap);
      return;
    }
    throw InvalidModel(where(use), "the curve is up to " + format_number(hausdorff_distance(first, other, infinity)) +
                                       " away from " + name(shape.uses.front()) +
                                       ", which has the same reference (tolerance " + format_number(apart_) + ")");
  }

  // The ends of a closed curve do not determine its direction: it is the direction in which the shapes agree.
  [[nodiscard]] bool runs_against(const Curve& shape, const CurveUse& use) const {
    const std::span<const Vec3> first = trace(shape.uses.front()), other = trace(use);
    double along = 0, back = 0;
    for (int i = 1; i <= probes; ++i) {
      const double r = static_cast<double>(i) / (probes + 1);
      const Vec3 p = trace_point(first, r);
      along = std::max(along, norm(p - trace_point(other, r)));
      back = std::max(back, norm(p - trace_point(other, 1 - r)));
    }
    const double gap = std::min(along, back);
    if (gap > apart_)
      throw InvalidModel(where(use), "the closed curve and " + name(shape.uses.front()) +
                                         ", which has the same reference, are " + format_number(gap) +
                                         " apart at equal lengths: do both start at the same point?");
    // A curve that agrees in both directions, there and back on one line, may take any.
    if (gap > std::max(0.5 * std::max(along, back), point_share * eps_))
      throw InvalidModel(where(use), "the direction of the closed curve is ambiguous: it is as near to " +
                                         name(shape.uses.front()) + " forwards (" + format_number(along) +
                                         ") as backwards (" + format_number(back) + ")");
    return back < along;
  }

  void collect_curves_of_points() {
    for (int c = 0; c < static_cast<int>(topology_.curves.size()); ++c)
      for (const int p : {topology_.curves[c].end1, topology_.curves[c].end2}) {
        auto& curves = topology_.points[p].curves;
        if (curves.empty() || curves.back() != c) curves.push_back(c);
      }
  }

  const Model& model_;
  const CurveTraces& traces_;
  double eps_, apart_;
  int wide_ = 0;  // gaps between eps_ and apart_
  double widest_ = 0;
  std::string widest_place_;
  std::map<int, double> point_extent_;  // by curve reference, of small loops: larger ones are no points
  std::map<int, std::size_t> rank_;     // of point references, by first appearance
  std::vector<double> slack_;           // by rank, of the sets' smallest
  UnionFind corners_;                   // of ranks
  std::map<std::size_t, int> index_of_corner_;
  std::vector<double> slack_of_point_;
  std::map<int, int> curve_of_ref_;
  Topology topology_;
};

}  // namespace

Topology build_topology(const Model& model, const CurveTraces& traces, double eps, double eps_match,
                        std::vector<std::string>* remarks) {
  if (!(eps > 0) || !std::isfinite(eps))
    throw InvalidArgument("the tolerance of curves in space must be positive; it is " + format_number(eps));
  check_traces(model, traces);
  TopologyBuilder builder(model, traces, eps, eps_match);
  Topology topology = builder.run();
  if (const std::string remark = builder.remark(); remarks != nullptr && !remark.empty()) remarks->push_back(remark);
  return topology;
}

}  // namespace carreau
