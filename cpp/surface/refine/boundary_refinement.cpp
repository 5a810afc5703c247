// SPDX-License-Identifier: BSD-3-Clause
#include "surface/refine/boundary_refinement.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "cad/continued_cad.h"
#include "predicates/predicates.h"
#include "support/infinity.h"
#include "support/rounding_of.h"
#include "support/segment.h"
#include "support/stepped_tasks.h"
#include "periodic/shared_curves.h"
#include "surface/domain/domain_check.h"
#include "surface/domain/near_vertices.h"
#include "surface/refine/bulging_edges.h"
#include "surface/refine/face_closeness.h"
#include "surface/refine/finest_lengths.h"
#include "surface/refine/seam_loops.h"
#include "surface/refine/staggering.h"
#include "surface/refine/strips.h"
#include "surface/refine/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::refine;

/// Segments to split, by curve.
using Splits = std::map<int, std::set<int>>;

class Refiner {
 public:
  Refiner(const CurveModel& model, const SizeRules& rules, const CompositeOptions& options, const SizeLimits& limits,
          const NarrowModel& narrow, std::vector<DiscreteCurve>& curves, const PeriodicModel* periodic, const std::vector<char>& uneven,
          std::set<int>& given_up, Monitor& monitor)
      : curve_model_(model),
        model_(model.model),
        topology_(model.topology),
        rules_(rules),
        options_(options),
        limits_(limits),
        narrow_(narrow),
        strips_(narrow.strips),
        curves_(curves),
        periodic_(periodic),
        uneven_(uneven),
        given_up_(given_up),
        monitor_(monitor) {
    const std::size_t n = model_.faces.size();
    result_.domain.resize(n);
    result_.failure.resize(n);
    result_.mended.resize(n, 0);
    stale_.assign(n, 1);
    changed_.assign(n, 1);
    crossable_.assign(n, 1);
    left_out_.assign(n, 0);
    spaces_.resize(n);
    for (std::size_t f = 0; f < n; ++f) {
      result_.failure[f] = model_.faces[f].left_out;
      if (!result_.failure[f].empty()) left_out_[f] = 1;
    }
    for (std::size_t f = 0; f < n; ++f)
      if (model_.faces[f].is_wire()) left_out_[f] = 1;
    for (const NarrowFace& face : strips_) left_out_[face.face] = 1;
    for (const int f : narrow_.folded) left_out_[f] = 1;
    if (!narrow_.vanishing.curve.empty())
      for (const NarrowFace& face : narrow_.points) left_out_[face.face] = 1;
  }

  RefinedDomains run() {
    uncross();
    rebuild_stale();
    closeness_.emplace(curve_model_, curves_, result_.domain, options_);
    repeat(
        options_.check_close_edges, [this](int f) { return look_for_closeness(f); },
        [this](int f, Found& found, Monitor& monitor) {
          found.edges =
              edges_to_split_for_waists(curve_model_, curves_, f, result_.domain[f]->plane, options_.coef_rectangle);
          const std::vector<int> bulging =
              edges_to_split_for_bulges(curve_model_, curves_, f, *result_.domain[f], closeness_->coefficient(f));
          found.edges.insert(found.edges.end(), bulging.begin(), bulging.end());
          if (!found.ask_metric) return;
          int wide = -1;  // the last edge that a strip has shown to be too long
          for (const Strip& strip : found.strips)
            if (strip.edge != wide && lies_between(curve_model_, f, *result_.domain[f], strip))
              found.edges.push_back(wide = strip.edge);
          const std::vector<int> close = edges_to_split_for_closeness(
              result_.domain[f]->plane, space_of(f, monitor), closeness_->coefficient(f), closeness_->is_bounded(f));
          found.edges.insert(found.edges.end(), close.begin(), close.end());
          std::erase_if(found.edges, [&](int e) {
            const PlaneEdge& edge = result_.domain[f]->plane.edges[e];
            return closeness_->is_fine(f, curves_[edge.curve], edge.segment);
          });
        });
    if (!isotropic_) finest_.emplace(topology_, curves_);
    repeat(
        options_.check_adjacent_edges, [this](int f) { return Found{.ask_metric = !is_uneven(f) && may_be_unbalanced(f)}; },
        [this](int f, Found& found, Monitor& monitor) {
          if (!found.ask_metric) return;
          const PlaneDomain& plane = result_.domain[f]->plane;
          found.edges = has_one_size() && is_continued(curve_model_.cad, model_.faces[f].ref)
                            ? edges_to_split_for_balance(plane, lengths_on_curves(plane), options_.adjacent_ratio, 2)
                            : edges_to_split_for_balance(plane, space_of(f, monitor), options_.adjacent_ratio);
          if (!finest_) return;
          std::erase_if(found.edges, [&](int e) {
            return finest_->reached_by(curves_[plane.edges[e].curve], plane.edges[e].segment);
          });
        });
    stagger_strips();
    for (int i = 0; i < options_.check_well_defined; ++i) uncross();
    uncross();
    report_what_still_crosses();
    return std::move(result_);
  }

 private:
  /// The result of a check for one face.
  struct Found {
    std::vector<int> edges = {};  // to be split
    std::vector<Strip> strips = {};
    bool ask_metric = false;
  };

  [[nodiscard]] int face_count() const { return static_cast<int>(model_.faces.size()); }
  void rebuild_stale() {
    std::vector<int> stale;
    for (int f = 0; f < face_count(); ++f) {
      if (stale_[f] == 0 || left_out_[f] != 0 || !result_.failure[f].empty()) continue;
      stale_[f] = 0;
      changed_[f] = crossable_[f] = 1;
      result_.domain[f].reset();
      stale.push_back(f);
    }
    std::vector<char> turned(stale.size(), 0);  // repaired by refine(), or reported at the end
    std::vector<std::string> failure(stale.size());
    const auto build = [&](std::size_t i, Monitor&) {
      try {
        result_.domain[stale[i]] = build_face_domain(model_, topology_, curves_, stale[i], narrow_.vanishing);
      } catch (const TurnedDomain& error) {
        turned[i] = 1;
        failure[i] = error.what();
      } catch (const DomainError& error) {
        failure[i] = error.what();
      }
    };
    run_each(stale.size(), false, options_.executor.threads, build, monitor_);
    for (std::size_t i = 0; i < stale.size(); ++i) {
      const int f = stale[i];
      if (failure[i].empty()) {
        unbuilt_.erase(f);
        turned_.erase(f);
      } else {
        unbuilt_[f] = failure[i];
        if (turned[i] != 0) turned_.insert(f);
      }
    }
  }

  // Rounds of one check, until no segment is split; later rounds check changed faces only.
  template <typename Find, typename Ask>
  void repeat(int rounds, Find&& find, Ask&& ask) {
    const bool alone = !asks_from_threads(options_, curve_model_.cad);
    rebuild_stale();
    changed_.assign(changed_.size(), 1);
    for (int i = 0; i < rounds; ++i)
      if (!refine(std::exchange(changed_, std::vector<char>(changed_.size(), 0)), find, ask, alone)) return;
  }

  // One round: splits the segments that the faces in `look` request, in every face that holds the curve. `find` does
  // not evaluate the host and runs on several threads. The function `ask` also runs on several threads, and may change
  // the result of `find`, unless it is to be `alone`.
  template <typename Find, typename Ask>
  bool refine(const std::vector<char>& look, Find&& find, Ask&& ask, bool alone) {
    rebuild_stale();
    Splits splits;
    add_loose_edges(splits);
    std::vector<int> asked;
    for (int f = 0; f < face_count(); ++f)
      if (result_.domain[f] && look[f] != 0 && !given_up_.contains(f)) asked.push_back(f);
    std::vector<Found> found(asked.size());
    const auto look_at = [&](std::size_t i, Monitor& monitor) {
      found[i] = find(asked[i]);
      if (!alone) ask(asked[i], found[i], monitor);
    };
    run_each(asked.size(), false, options_.executor.threads, look_at, monitor_);
    for (std::size_t i = 0; i < asked.size(); ++i) {
      const int f = asked[i];
      if (alone) ask(f, found[i], monitor_);
      for (const int e : found[i].edges) {
        const PlaneEdge& edge = result_.domain[f]->plane.edges[e];
        if (topology_.curves[edge.curve].degenerate) continue;
        if (curves_[edge.curve].prescribed) {
          result_.kept.insert(edge.curve);
          continue;
        }
        if (splits[edge.curve].insert(edge.segment).second) result_.mended[f] = 1;
      }
    }
    bool any = false;
    for (const auto& [curve, segments] : splits)
      for (auto segment = segments.rbegin(); segment != segments.rend(); ++segment) any |= split(curve, *segment);
    if (any && !strips_.empty()) complete_strips();
    if (any && periodic_ != nullptr)
      for (const int curve : complete_classes(*periodic_, curve_model_, curves_)) mark_stale(curve);
    rebuild_stale();
    return any;
  }

  void complete_strips() {
    const SidesMatched matched = complete_sides(curve_model_, strips_, curves_);
    for (const int curve : matched.changed) mark_stale(curve);
    leave_to_mesher(matched.unmatched, strips_);
    result_.unmatched.insert(result_.unmatched.end(), matched.unmatched.begin(), matched.unmatched.end());
    std::sort(result_.unmatched.begin(), result_.unmatched.end());
  }

  // If the polygon of a boundary is inside out it approximates its curves too loosely: the edges with the largest
  // distance are split.
  void add_loose_edges(Splits& splits) {
    for (const int face : turned_) {
      if (given_up_.contains(face) || turned_rounds_[face]++ >= max_fruitless_halvings) continue;
      struct Candidate {
        int curve, segment;
        double deviation;
      };
      std::vector<Candidate> candidates;
      double worst = 0;
      for (const int curve : topology_.curve_of[face]) {
        const DiscreteCurve& discrete = curves_[curve];
        if (discrete.indivisible || discrete.prescribed) continue;
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

  // Comes last, since halves of edges that were moved by half an edge would face each other again. Sides that were
  // matched stay so, and metrics by direction have no width in space.
  void stagger_strips() {
    if (!options_.stagger_strips || !narrow_.empty() || !isotropic_) return;
    rebuild_stale();
    for (const int c : curves_to_stagger(curve_model_, curves_, result_.domain, options_.executor.threads, monitor_)) {
      if (periodic_ != nullptr && !periodic_->empty() && periodic_->has_class[c] != 0) continue;
      stagger(curves_[c], curve_model_);
      mark_stale(c);
    }
    rebuild_stale();
  }

  bool split(int curve, int segment) {
    monitor_.checkpoint();
    if (!split_segment(curves_[curve], segment, curve_model_)) return false;
    mark_stale(curve);
    return true;
  }
  void mark_stale(int curve) {
    for (const CurveUse& use : topology_.curves[curve].uses) stale_[use.face] = 1;
  }

  // A face found free of crossings stays so until it changes.
  void uncross() {
    for (int i = 0; i < rounding_of::halvings; ++i)
      if (!refine(
              crossable_, [this](int f) { return Found{edges_to_split_for_crossings(result_.domain[f]->plane)}; },
              [this](int f, Found& found, Monitor&) { give_up_if_fruitless(f, found); }, true))
        return;
  }

  void give_up_if_fruitless(int f, Found& found) {
    const PlaneDomain& plane = result_.domain[f]->plane;
    double length = 0;
    for (const int e : found.edges) length += norm(plane.vertices[plane.edges[e].b] - plane.vertices[plane.edges[e].a]);
    Crossing& before = crossings_[f];
    before.fruitless = length > fruitless_share * before.length ? before.fruitless + 1 : 0;
    before.length = length;
    if (before.fruitless > max_fruitless_halvings) {
      given_up_.insert(f);
      found.edges.clear();
    }
    crossable_[f] = found.edges.empty() ? 0 : 1;
  }

  [[nodiscard]] Found look_for_closeness(int f) const {
    if (!may_be_narrow(f)) return {};
    return {.strips = find_strips(curve_model_, curves_, f, *result_.domain[f], closeness_->coefficient(f)),
            .ask_metric = true};
  }

  // Returns whether closeness needs a look: in space, a vertex is nearer to another edge than the check allows. Costs
  // no callback. If metrics have directions, distances in space do not measure closeness.
  [[nodiscard]] bool may_be_narrow(int f) const {
    if (!isotropic_) return true;
    const FaceDomain& domain = *result_.domain[f];
    const std::vector<Vec3> xyz = positions_on_curves(domain, curves_, topology_);
    if (xyz.size() < domain.origin.size()) return true;  // imposed points
    NearVertices near(xyz);
    for (const PlaneEdge& edge : domain.plane.edges) {
      if (edge.kind == PlaneEdgeKind::degenerate) continue;
      const Vec3 a = xyz[edge.a], b = xyz[edge.b];
      if (near.any_beside(a, b, straight_reserve * closeness_->coefficient(f) * norm(b - a))) return true;
    }
    return false;
  }

  // Returns whether edges at a vertex differ so much that the balance needs a look. With a uniform size lengths on
  // curves decide, without a callback. With a gradation they decide together with the largest change of sizes up to the
  // middles of edges.
  [[nodiscard]] bool is_uneven(int f) const { return static_cast<std::size_t>(f) < uneven_.size() && uneven_[f] != 0; }
  // Lengths on curves are exact then. Halved edges are exactly twice as long as their neighbours: in a metric that is sampled,
  // or at the middle of a chord, the error of lengths would decide whether they stay.
  [[nodiscard]] bool has_one_size() const { return rules_.constant() && isotropic_ && !limits_.want_places(); }
  // Zero for degenerate edges.
  [[nodiscard]] std::vector<double> lengths_on_curves(const PlaneDomain& plane) const {
    std::vector<double> lengths;
    for (const PlaneEdge& edge : plane.edges) {
      if (edge.kind == PlaneEdgeKind::degenerate) {
        lengths.push_back(0);
        continue;
      }
      const std::vector<double>& r = curves_[edge.curve].r;
      lengths.push_back((r[edge.segment + 1] - r[edge.segment]) * curve_model_.length(edge.curve));
    }
    return lengths;
  }
  [[nodiscard]] bool may_be_unbalanced(int f) const {
    if (!rules_.constant() && (limits_.field == nullptr || !isotropic_)) return true;
    const double half_slope = rules_.constant() ? 0 : 0.5 * limits_.field->slope();
    const FaceDomain& domain = *result_.domain[f];
    struct Range {
      double low = infinity, high = 0;
    };
    std::vector<Range> at(domain.plane.vertices.size());
    for (const PlaneEdge& edge : domain.plane.edges) {
      if (edge.kind == PlaneEdgeKind::degenerate) continue;
      const std::vector<double>& r = curves_[edge.curve].r;
      const double length = (r[edge.segment + 1] - r[edge.segment]) * curve_model_.length(edge.curve);
      for (const int v : {edge.a, edge.b})
        at[v] = {.low = std::min(at[v].low, length), .high = std::max(at[v].high, length)};
    }
    for (std::size_t v = 0; v < at.size(); ++v) {
      const auto [low, high] = at[v];
      const double least = 1 - half_slope * high / domain.size[v], most = 1 + half_slope * low / domain.size[v];
      if (high * most > balance_to_look_at * low * least) return true;
    }
    return false;
  }

  // Loose spaces are enough to compare edges with their neighbours; they are kept while the curves change.
  const ControlSpace& space_of(int f, Monitor& monitor) {
    auto& space = spaces_[f];
    if (!space) space = sample_face(input_of(f), curve_model_.cad, rules_, {}, monitor);
    return *space;
  }
  [[nodiscard]] PatchInput input_of(int f) const {
    return {.face = f, .ref = model_.faces[f].ref, .domain = &*result_.domain[f], .curve_xyz = {}, .isotropic = isotropic_, .limits = limits_};
  }

  void report_what_still_crosses() {
    const auto look = [&](std::size_t f, Monitor&) {
      if (!result_.domain[f]) return;
      result_.failure[f] = why_not(static_cast<int>(f));
      if (!result_.failure[f].empty()) result_.domain[f].reset();
    };
    run_each(result_.domain.size(), false, options_.executor.threads, look, monitor_);
    for (const auto& [f, why] : unbuilt_) result_.failure[f] = why;
  }

  // Returns the reason why a domain cannot be meshed; empty if it can.
  [[nodiscard]] std::string why_not(int f) const {
    const PlaneDomain& plane = result_.domain[f]->plane;
    if (const std::optional<EdgeConflict> conflict = find_a_crossing(plane)) {
      const PlaneEdge &first = plane.edges[conflict->first], &second = plane.edges[conflict->second];
      return Where{.face = model_.faces[f].ref, .uv = conflict->uv}.prefix() +
             (!cross(plane, first, second) ? "the discretised boundary meets itself: "
              : first.kind == PlaneEdgeKind::internal || second.kind == PlaneEdgeKind::internal
                  ? "discretised curves cross: "
                  : "the discretised boundary crosses itself: ") +
             name_of(first, f) + " and " + name_of(second, f);
    }
    const std::vector<std::string> defects =
        find_loop_defects(plane, [&](const PlaneEdge& edge) { return name_of(edge, f); });
    return defects.empty() ? std::string() : Where{.face = model_.faces[f].ref}.prefix() + defects.front();
  }

  /// Each edge has an end on either side of the other.
  [[nodiscard]] static bool cross(const PlaneDomain& plane, const PlaneEdge& first, const PlaneEdge& second) {
    const auto divides = [&](const PlaneEdge& line, const PlaneEdge& other) {
      const auto side = [&](int v) { return orientation(plane.vertices[line.a], plane.vertices[line.b], plane.vertices[v]); };
      return (side(other.a) > 0 && side(other.b) < 0) || (side(other.a) < 0 && side(other.b) > 0);
    };
    return divides(first, second) && divides(second, first);
  }

  [[nodiscard]] std::string name_of(const PlaneEdge& edge, int face) const {
    return "an edge of " + curve_name(topology_, edge.curve, face);
  }

  const CurveModel& curve_model_;
  const Model& model_;
  const Topology& topology_;
  const SizeRules& rules_;
  const bool isotropic_ = !rules_.uses_metrics();
  const CompositeOptions& options_;
  SizeLimits limits_;
  const NarrowModel& narrow_;
  std::vector<NarrowFace> strips_;  // whose sides have vertices at the same places
  std::vector<char> left_out_;  // by face
  std::vector<DiscreteCurve>& curves_;
  const PeriodicModel* periodic_;  // null: none
  const std::vector<char>& uneven_;
  std::set<int>& given_up_;  // faces whose edges are no longer cut
  Monitor& monitor_;
  RefinedDomains result_;
  std::vector<char> stale_;
  std::vector<char> changed_;    // since the last round of a check
  std::vector<char> crossable_;  // since no crossing was found
  std::map<int, std::string> unbuilt_;
  std::set<int> turned_;  // among these faces
  std::map<int, int> turned_rounds_;
  struct Crossing {
    double length = infinity;  // of the edges that cross others, in (u, v)
    int fruitless = 0;         // halvings in a row that left it as it was
  };
  std::map<int, Crossing> crossings_;
  std::optional<FaceCloseness> closeness_;           // once boundaries do not cross
  std::optional<FinestLengths> finest_;              // before edges were balanced; none without metrics
  std::vector<std::optional<ControlSpace>> spaces_;  // by face
};

}  // namespace

RefinedDomains refine_domains(const CurveModel& model, const SizeRules& rules, const CompositeOptions& options,
                              const SizeLimits& limits, const NarrowModel& narrow, std::vector<DiscreteCurve>& curves,
                              Monitor& monitor, const PeriodicModel* periodic, const std::vector<char>& uneven) {
  const std::vector<DiscreteCurve> unrefined = curves;
  std::set<int> given_up;
  std::map<int, std::string> why;
  for (;;) {
    RefinedDomains result = Refiner(model, rules, options, limits, narrow, curves, periodic, uneven, given_up, monitor).run();
    const std::size_t known = why.size();
    for (int f = 0; f < static_cast<int>(result.failure.size()); ++f)
      if (!result.failure[f].empty() && result.mended[f] != 0) why.emplace(f, result.failure[f]), given_up.insert(f);
    if (why.size() == known) {
      for (const auto& [f, sentence] : why) result.failure[f] = sentence;
      return result;
    }
    curves = unrefined;  // cut for a face that has no mesh anyway, they would make the meshes of its neighbours finer
  }
}

void separate_coincident_curves(const CurveModel& model, std::vector<DiscreteCurve>& curves) {
  std::map<std::pair<int, int>, std::vector<int>> by_ends;
  for (int c = 0; c < static_cast<int>(curves.size()); ++c) {
    const Curve& shape = model.curve(c);
    if (!shape.degenerate && curves[c].segments() == 1) by_ends[std::minmax(shape.end1, shape.end2)].push_back(c);
  }
  for (const auto& [ends, same] : by_ends) {
    if (same.size() < 2) continue;
    int prescribed = -1;
    for (const int c : same) {
      if (!curves[c].prescribed) split_segment(curves[c], 0, model);
      if (!curves[c].prescribed) continue;
      if (prescribed >= 0)
        throw InvalidModel(Where{.curve = model.curve(c).ref},
                           "one edge is prescribed on the curve, and on curve " +
                               std::to_string(model.curve(prescribed).ref) +
                               ", which has the same ends: the two edges would be one");
      prescribed = c;
    }
  }
}

}  // namespace carreau
