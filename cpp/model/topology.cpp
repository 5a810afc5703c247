#include "model/topology.h"

#include <algorithm>
#include <map>

#include "model/traces.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

// Where closed curves are compared to tell their direction; not symmetric about the middle.
constexpr double probes[] = {0.2, 0.3, 0.6};

class TopologyBuilder {
 public:
  TopologyBuilder(const Model& model, const CurveTraces& traces, double eps)
      : model_(model), traces_(traces), eps_(eps) {}

  Topology run() {
    for (std::size_t f = 0; f < model_.faces.size(); ++f) {
      topology_.curve_of.emplace_back();
      for (std::size_t c = 0; c < model_.faces[f].curves.size(); ++c) add_use(static_cast<int>(f), static_cast<int>(c));
    }
    collect_curves_of_points();
    return std::move(topology_);
  }

 private:
  [[nodiscard]] const FaceCurve& face_curve(const CurveUse& use) const {
    return model_.faces[use.face].curves[use.curve];
  }
  [[nodiscard]] std::span<const Vec3> trace(const CurveUse& use) const { return traces_[use.face][use.curve]; }
  [[nodiscard]] Where where(const CurveUse& use) const {
    const FaceCurve& curve = face_curve(use);
    return {.face = model_.faces[use.face].ref,
            .curve_index = use.curve + 1,
            .curve = curve.ref,
            .file = curve.line > 0 ? model_.source : "",
            .line = curve.line};
  }

  int point(int ref, Vec3 position) {
    const auto [it, added] = point_of_.try_emplace(ref, static_cast<int>(topology_.points.size()));
    if (added) topology_.points.push_back({ref, position, {}});
    return it->second;
  }

  void add_use(int f, int c) {
    CurveUse use{f, c, false};
    const FaceCurve& curve = face_curve(use);
    const auto [it, first] = curve_of_ref_.try_emplace(curve.ref, static_cast<int>(topology_.curves.size()));
    topology_.curve_of[f].push_back(it->second);
    const int end1 = point(curve.end1, trace(use).front()), end2 = point(curve.end2, trace(use).back());
    const bool one_point = curve.collapsed || trace_extent(trace(use)) <= 1e-3 * eps_;
    if (first) {
      if (end1 == end2 && !one_point && norm(trace(use).back() - trace(use).front()) > eps_)
        throw InvalidModel(where(use), "refp1 and refp2 are the same, yet the ends of the curve are " +
                                           format_number(norm(trace(use).back() - trace(use).front())) + " apart");
      topology_.curves.push_back({curve.ref, {use}, end1, end2, one_point});
      return;
    }
    Curve& shape = topology_.curves[it->second];
    const bool same = end1 == shape.end1 && end2 == shape.end2, against = end1 == shape.end2 && end2 == shape.end1;
    if (!same && !against)
      throw InvalidModel(where(use), "its ends are not those of the other curves of the same reference");
    use.reversed = same && against ? runs_against(shape, use) : against;
    if (!shape.degenerate) check_gap(shape, use);
    shape.uses.push_back(use);
  }

  // A closed curve says nothing by its ends: the direction is the one in which the shapes agree.
  bool runs_against(const Curve& shape, const CurveUse& use) const {
    if (shape.degenerate) return false;
    const std::span<const Vec3> first = trace(shape.uses.front()), other = trace(use);
    double along = 0, back = 0;
    for (const double r : probes) {
      along = std::max(along, norm(trace_point(first, r) - trace_point(other, r)));
      back = std::max(back, norm(trace_point(first, r) - trace_point(other, 1 - r)));
    }
    if (std::min(along, back) > eps_)
      throw InvalidModel(where(use), "the closed curve is " + format_number(std::min(along, back)) +
                                         " away from the first curve of the same reference");
    return back < along;
  }

  void check_gap(const Curve& shape, const CurveUse& use) const {
    const double gap = hausdorff_distance(trace(shape.uses.front()), trace(use), eps_);
    if (gap > eps_)
      throw InvalidModel(where(use), "the curve is " + format_number(gap) + " or more away from curve " +
                                         std::to_string(shape.uses.front().curve + 1) + " of face " +
                                         std::to_string(model_.faces[shape.uses.front().face].ref) +
                                         ", which has the same reference");
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
  double eps_;
  Topology topology_;
  std::map<int, int> curve_of_ref_, point_of_;
};

}  // namespace

Topology build_topology(const Model& model, const CurveTraces& traces, double eps) {
  return TopologyBuilder(model, traces, eps).run();
}

}  // namespace carreau
