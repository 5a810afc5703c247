#include "surface/boundary_refinement.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "plane/domain_check.h"
#include "support/segment.h"

namespace carreau {

namespace {

// Each iteration halves the edges that cross: 2^-16 of an edge is below the accuracy of any support.
constexpr int most_halvings = 16;

// And those of a boundary that is inside out: a model that is wrong stays so.
constexpr int most_turned_rounds = 6;
// Straight distances in space are taken this much shorter than lengths in the metric of a curved surface.
constexpr double straight_reserve = 2;

/// Segments to split, by curve.
using Splits = std::map<int, std::set<int>>;

/// Vertices in the order of the coordinate along which they are spread most.
class NearVertices {
 public:
  explicit NearVertices(const std::vector<Vec3>& points) : points_(points), order_(points.size()) {
    Vec3 low = points.empty() ? Vec3{} : points.front(), high = low;
    for (const Vec3 p : points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const Vec3 extent = high - low;
    axis_ = extent.x >= extent.y && extent.x >= extent.z ? &Vec3::x : extent.y >= extent.z ? &Vec3::y : &Vec3::z;
    std::iota(order_.begin(), order_.end(), 0);
    std::sort(order_.begin(), order_.end(), [this](int v, int w) { return points_[v].*axis_ < points_[w].*axis_; });
  }

  /// Is a vertex that `counts` within `reach` of the segment (a, b), one that is at neither end of it?
  template <typename Counts>
  [[nodiscard]] bool any_beside(Vec3 a, Vec3 b, double reach, Counts&& counts) const {
    const double low = std::min(a.*axis_, b.*axis_) - reach, high = std::max(a.*axis_, b.*axis_) + reach;
    auto it = std::lower_bound(order_.begin(), order_.end(), low,
                               [this](int v, double value) { return points_[v].*axis_ < value; });
    for (; it != order_.end() && points_[*it].*axis_ <= high; ++it) {
      const Vec3 p = points_[*it];
      if (!(p == a) && !(p == b) && distance_to_segment(p, a, b) <= reach && counts(*it)) return true;
    }
    return false;
  }

 private:
  const std::vector<Vec3>& points_;
  std::vector<int> order_;
  double Vec3::*axis_ = &Vec3::x;
};

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
    changed_.assign(n, 1);
  }

  RefinedDomains run() {
    uncross();
    repeat(options_.check_close_edges, [this](int f) {
      if (!may_be_narrow(f)) return std::vector<int>{};
      std::vector<int> edges =
          edges_to_split_for_closeness(result_.domain[f]->plane, space_of(f), options_.coef_rectangle);
      const std::vector<int> by_chord = edges_close_in_space(f);
      edges.insert(edges.end(), by_chord.begin(), by_chord.end());
      return edges;
    });
    repeat(options_.check_adjacent_edges,
           [this](int f) { return edges_to_split_for_balance(result_.domain[f]->plane, space_of(f)); });
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
      changed_[f] = 1;
      result_.domain[f].reset();
      try {
        result_.domain[f] = build_face_domain(model_, topology_, curves_, f);
      } catch (const TurnedDomain& error) {
        turned_.insert(f);  // mended by refine(), or reported at the end
        unbuilt_[f] = error.what();
        continue;
      } catch (const DomainError& error) {
        unbuilt_[f] = error.what();
        continue;
      }
      unbuilt_.erase(f);
      turned_.erase(f);
    }
  }

  // Rounds of one check, until nothing more is split; only faces that have changed are looked at again.
  template <typename FindEdges>
  void repeat(int rounds, FindEdges&& find_edges) {
    rebuild_stale();
    changed_.assign(changed_.size(), 1);
    for (int i = 0; i < rounds; ++i) {
      const std::vector<char> look = std::exchange(changed_, std::vector<char>(changed_.size(), 0));
      if (!refine([&](int f) { return look[f] != 0 ? find_edges(f) : std::vector<int>{}; })) return;
    }
  }

  // One round: asks every face which edges to split, splits them in every face that holds the curve.
  template <typename FindEdges>
  bool refine(FindEdges&& find_edges) {
    rebuild_stale();
    Splits splits;
    add_loose_edges(splits);
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

  // A boundary whose polygon is inside out follows its curves too loosely: there the edges that leave them most are
  // split.
  void add_loose_edges(Splits& splits) {
    for (const int face : turned_) {
      if (turned_rounds_[face]++ >= most_turned_rounds) continue;
      struct Candidate {
        int curve, segment;
        double deviation;
      };
      std::vector<Candidate> candidates;
      double worst = 0;
      for (const int curve : topology_.curve_of[face]) {
        const DiscreteCurve& discrete = curves_[curve];
        if (discrete.indivisible) continue;
        for (int k = 0; k < discrete.segments(); ++k) {
          candidates.push_back({curve, k, deviation(face, discrete, k)});
          worst = std::max(worst, candidates.back().deviation);
        }
      }
      for (const Candidate& c : candidates)
        if (c.deviation >= worst / 4 && worst > 0 && splits[c.curve].insert(c.segment).second) result_.mended[face] = 1;
    }
  }

  // Distance of a segment's support to its chord in the parameter plane of a face; the largest of all uses in the face.
  [[nodiscard]] double deviation(int face, const DiscreteCurve& discrete, int k) const {
    double largest = 0;
    const auto& uses = topology_.curves[discrete.curve].uses;
    for (std::size_t u = 0; u < uses.size(); ++u) {
      if (uses[u].face != face) continue;
      const CurveSupport& support = curve_model_.support(uses[u]);
      const Vec2 p = discrete.uv_of_use[u][k], q = discrete.uv_of_use[u][k + 1];
      const auto [low, high] = std::minmax(discrete.t_of_use[u][k], discrete.t_of_use[u][k + 1]);
      for (std::size_t i = 0; i < support.t.size(); ++i)
        if (low < support.t[i] && support.t[i] < high)
          largest = std::max(largest, distance_to_segment(support.uv[i], p, q));
    }
    return largest;
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

  // Whether closeness needs a look: in space, no vertex is as near to an edge that it does not end as the check allows.
  // Costs no callback. Where metrics have directions, distances in space say nothing.
  bool may_be_narrow(int f) {
    if (rules_.uses_metrics()) return true;
    const FaceDomain& domain = *result_.domain[f];
    const std::vector<Vec3> xyz = positions_on_curves(domain, curves_, topology_);
    if (xyz.size() < domain.origin.size()) return true;  // imposed points
    const NearVertices near(xyz);
    for (const PlaneEdge& edge : domain.plane.edges) {
      if (edge.kind == PlaneEdgeKind::degenerate) continue;
      const Vec3 a = xyz[edge.a], b = xyz[edge.b];
      if (near.any_beside(a, b, straight_reserve * options_.coef_rectangle * norm(b - a), [](int) { return true; }))
        return true;
    }
    return false;
  }

  // On a strip that is no wider than its long edges bulge, the chord of an edge passes by vertices of the other side
  // however far they are on the surface. Curves that meet at a corner are left to the check in the metric, which knows
  // angles.
  std::vector<int> edges_close_in_space(int f) {
    std::vector<int> close;
    const FaceDomain& domain = *result_.domain[f];
    const std::vector<Vec3> xyz = positions_on_curves(domain, curves_, topology_);
    if (xyz.size() < domain.origin.size()) return close;  // imposed points
    const NearVertices near(xyz);
    for (int e = 0; e < static_cast<int>(domain.plane.edges.size()); ++e) {
      const PlaneEdge& edge = domain.plane.edges[e];
      if (edge.kind == PlaneEdgeKind::degenerate) continue;
      const Vec3 a = xyz[edge.a], b = xyz[edge.b];
      const auto is_apart = [&](int v) { return !meet(edge.curve, domain.origin[v]); };
      if (near.any_beside(a, b, options_.coef_rectangle * norm(b - a), is_apart)) close.push_back(e);
    }
    return close;
  }

  // Whether a vertex lies on a curve that has an end in common with another one, or on that one.
  [[nodiscard]] bool meet(int curve, const DomainVertexOrigin& origin) const {
    const Curve& one = topology_.curves[curve];
    if (origin.corner >= 0) return origin.corner == one.end1 || origin.corner == one.end2;
    const Curve& other = topology_.curves[origin.curve];
    return origin.curve == curve || other.end1 == one.end1 || other.end1 == one.end2 || other.end2 == one.end1 ||
           other.end2 == one.end2;
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
  std::vector<char> changed_;  // since the last round of a check
  std::map<int, std::string> unbuilt_;
  std::set<int> turned_;  // of those
  std::map<int, int> turned_rounds_;
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
