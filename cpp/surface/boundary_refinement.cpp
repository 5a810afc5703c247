#include "surface/boundary_refinement.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "plane/domain_check.h"

namespace carreau {

namespace {

// Each iteration halves the edges that cross: 2^-16 of an edge is below the accuracy of any support.
constexpr int most_halvings = 16;

/// Segments to split, by curve.
using Splits = std::map<int, std::set<int>>;

class Refiner {
 public:
  Refiner(const CurveModel& model, SizeRules& rules, const CompositeOptions& options, const SizeLimits& limits,
          std::vector<DiscreteCurve>& curves, Monitor& monitor)
      : curve_model_(model),
        model_(model.model),
        topology_(model.topology),
        rules_(rules),
        options_(options),
        limits_(limits),
        curves_(curves),
        monitor_(monitor) {
    const std::size_t n = model_.faces.size();
    result_.domain.resize(n);
    result_.failure.resize(n);
    result_.mended.resize(n, 0);
    stale_.assign(n, 1);
  }

  RefinedDomains run() {
    uncross();
    for (int i = 0; i < options_.check_close_edges; ++i)
      refine([this](int f) {
        return edges_to_split_for_closeness(result_.domain[f]->plane, space_of(f), options_.coef_rectangle);
      });
    for (int i = 0; i < options_.check_adjacent_edges; ++i)
      refine([this](int f) { return edges_to_split_for_balance(result_.domain[f]->plane, space_of(f)); });
    for (int i = 0; i < options_.check_well_defined; ++i) uncross();
    uncross();
    report_what_still_crosses();
    return std::move(result_);
  }

 private:
  [[nodiscard]] int face_count() const { return static_cast<int>(model_.faces.size()); }

  void rebuild_stale() {
    for (int f = 0; f < face_count(); ++f) {
      if (stale_[f] == 0 || !result_.failure[f].empty()) continue;
      monitor_.checkpoint();
      stale_[f] = 0;
      result_.domain[f].reset();
      try {
        result_.domain[f] = build_face_domain(model_, topology_, curves_, f);
      } catch (const DomainError& error) {
        unbuilt_[f] = error.what();
        continue;
      }
      unbuilt_.erase(f);
    }
  }

  // One round: asks every face which edges to split, splits them in every face that holds the curve.
  template <typename FindEdges>
  bool refine(FindEdges&& find_edges) {
    rebuild_stale();
    Splits splits;
    for (int f = 0; f < face_count(); ++f) {
      if (!result_.domain[f]) continue;
      for (const int e : find_edges(f)) {
        const PlaneEdge& edge = result_.domain[f]->plane.edges[e];
        if (topology_.curves[edge.curve].degenerate) continue;
        if (splits[edge.curve].insert(edge.segment).second) result_.mended[f] = 1;
      }
    }
    bool any = false;
    for (const auto& [curve, segments] : splits)
      for (auto segment = segments.rbegin(); segment != segments.rend(); ++segment) any |= split(curve, *segment);
    rebuild_stale();
    return any;
  }

  bool split(int curve, int segment) {
    if (!split_segment(curves_[curve], segment, curve_model_)) return false;
    for (const CurveUse& use : topology_.curves[curve].uses) stale_[use.face] = 1;
    return true;
  }

  void uncross() {
    for (int i = 0; i < most_halvings; ++i)
      if (!refine([this](int f) { return edges_to_split_for_crossings(result_.domain[f]->plane); })) return;
  }

  // Loose spaces are enough to compare edges with their neighbours; they are kept while the curves change.
  const ControlSpace& space_of(int f) {
    auto& space = spaces_[f];
    if (!space) {
      const PatchInput input{
          .face = f, .ref = model_.faces[f].ref, .domain = &*result_.domain[f], .curve_xyz = {}, .limits = limits_};
      space = sample_face(input, curve_model_.cad, rules_, {}, monitor_);
    }
    return *space;
  }

  void report_what_still_crosses() {
    for (int f = 0; f < face_count(); ++f) {
      if (const auto it = unbuilt_.find(f); it != unbuilt_.end()) result_.failure[f] = it->second;
      if (!result_.domain[f]) continue;
      const PlaneDomain& plane = result_.domain[f]->plane;
      const std::optional<EdgeConflict> conflict = find_a_crossing(plane);
      std::string why;
      if (conflict) {
        const Where where{.face = model_.faces[f].ref, .uv = conflict->uv};
        why = where.prefix() + "the discretised boundary meets itself: " + name_of(plane.edges[conflict->first], f) +
              " and " + name_of(plane.edges[conflict->second], f);
      } else if (const auto defects = find_loop_defects(plane, [&](const PlaneEdge& edge) { return name_of(edge, f); });
                 !defects.empty()) {
        why = Where{.face = model_.faces[f].ref}.prefix() + defects.front();
      }
      if (why.empty()) continue;
      result_.failure[f] = why;
      result_.domain[f].reset();
    }
  }

  [[nodiscard]] std::string name_of(const PlaneEdge& edge, int face) const {
    return "an edge of " + curve_name(topology_, edge.curve, face);
  }

  const CurveModel& curve_model_;
  const Model& model_;
  const Topology& topology_;
  SizeRules& rules_;
  const CompositeOptions& options_;
  SizeLimits limits_;
  std::vector<DiscreteCurve>& curves_;
  Monitor& monitor_;
  RefinedDomains result_;
  std::vector<char> stale_;
  std::map<int, std::string> unbuilt_;
  std::map<int, std::optional<ControlSpace>> spaces_;
};

}  // namespace

RefinedDomains refine_domains(const CurveModel& model, SizeRules& rules, const CompositeOptions& options,
                              const SizeLimits& limits, std::vector<DiscreteCurve>& curves, Monitor& monitor) {
  return Refiner(model, rules, options, limits, curves, monitor).run();
}

void separate_coincident_curves(const CurveModel& model, std::vector<DiscreteCurve>& curves) {
  std::map<std::pair<int, int>, std::vector<int>> by_ends;
  for (int c = 0; c < static_cast<int>(curves.size()); ++c) {
    const Curve& shape = model.curve(c);
    if (!shape.degenerate && curves[c].segments() == 1) by_ends[std::minmax(shape.end1, shape.end2)].push_back(c);
  }
  for (const auto& [ends, same] : by_ends)
    if (same.size() > 1)
      for (const int c : same) split_segment(curves[c], 0, model);
}

std::vector<Vec3> positions_on_curves(const FaceDomain& domain, const std::vector<DiscreteCurve>& curves,
                                      const Topology& topology) {
  std::vector<Vec3> positions;
  for (const DomainVertexOrigin& origin : domain.origin) {
    if (origin.curve < 0) break;
    positions.push_back(origin.corner >= 0 ? topology.points[origin.corner].position
                                           : curves[origin.curve].xyz[origin.node]);
  }
  return positions;
}

}  // namespace carreau
