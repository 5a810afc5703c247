// SPDX-License-Identifier: BSD-3-Clause
#include "session/gluing.h"

#include <algorithm>
#include <map>
#include <utility>

#include "model/geometries.h"
#include "model/places.h"
#include "model/splits.h"
#include "support/format.h"
#include "support/infinity.h"
#include "support/short_number.h"

namespace carreau {
namespace {

// A cut makes new ends, which can lie on further curves.
constexpr int max_rounds = 4;

/// Cuts curves, and builds the supports of their parts.
void apply_cuts(Model& model, ModelSupports& supports, Cad& host, const std::vector<CurveCut>& cuts, double angle_smo,
                Monitor& monitor) {
  std::vector<std::size_t> whole;  // curves of each face that were there before
  for (const Face& face : model.faces) whole.push_back(face.curves.size());
  model = cut_curves(model, cuts);
  PartCad cut_cad(host, parts_of(model));
  const auto build = [&](std::size_t f, std::size_t c) {
    monitor.checkpoint();
    return build_support(cut_cad, model.faces[f].ref, static_cast<int>(c) + 1, {.angle_deg = angle_smo});
  };
  for (const CurveCut& cut : cuts) supports.of_face[cut.face][cut.curve] = build(cut.face, cut.curve);
  for (std::size_t f = 0; f < model.faces.size(); ++f)
    for (std::size_t c = whole[f]; c < model.faces[f].curves.size(); ++c) supports.of_face[f].push_back(build(f, c));
}

/// Cuts curves once at ends of others that lie on them; returns false if there was nothing to cut.
bool cut_once(Model& model, ModelSupports& supports, Cad& host, const Gluing& options, Monitor& monitor) {
  std::map<std::pair<std::size_t, std::size_t>, CurveCut> cuts;
  PartCad cad(host, parts_of(model));
  for (const CurveSplit& split : find_splits(model, traces_of(supports), options.eps)) {
    monitor.checkpoint();
    const CurveSupport& support = supports.of_face[split.face][split.curve];
    const double a = support.t.front(), b = support.t.back();
    const int face = model.faces[split.face].ref, ic = static_cast<int>(split.curve) + 1;
    const double guess = support.t_at_arc(split.arc);
    const CurvePoint foot = refine_t(cad, face, ic, support, guess, a, b, split.end);
    if (split.gap > options.eps && foot.distance > options.eps) continue;  // it is near the trace only
    const double t = foot.t;
    auto& cut = cuts.try_emplace({split.face, split.curve}, CurveCut{split.face, split.curve, a, b, {}}).first->second;
    const double last = cut.t.empty() ? a : cut.t.back();
    if (t > last && t < b) cut.t.push_back(t);
  }
  std::vector<CurveCut> useful;
  for (const auto& [place, cut] : cuts)
    if (!cut.t.empty()) useful.push_back(cut);
  if (useful.empty()) return false;

  apply_cuts(model, supports, host, useful, options.angle_smo, monitor);
  return true;
}

std::string name_of(const Model& model, const GlueReport::Place& place) {
  return "face " + std::to_string(model.faces[place.face].ref) + " curve " +
         std::to_string(host_rank(model.faces[place.face], place.curve));
}

std::string count_of(std::size_t n, const std::string& one, const std::string& many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

void tell(const Model& model, const GlueReport& report, std::size_t parts, Monitor& monitor) {
  const GlueReport::Pair* widest = nullptr;
  for (const GlueReport::Pair& pair : report.pairs) {
    if (widest == nullptr || pair.gap > widest->gap) widest = &pair;
    monitor.message(Level::detail, name_of(model, pair.a) + " and " + name_of(model, pair.b) + " are one, within " +
                                       format_number(pair.gap));
  }
  for (const GlueReport::Place& place : report.open)
    monitor.message(Level::detail, name_of(model, place) + " is open: no other curve lies on it");
  std::string sentence = count_of(report.pairs.size(), "pair of curves is", "pairs of curves are") + " one";
  if (widest != nullptr) sentence += " within " + short_number(widest->gap);
  if (parts > 0) sentence += "; " + count_of(parts, "cut was made", "cuts were made") + " where curves of others end";
  sentence += "; " + count_of(report.open.size(), "curve is", "curves are") + " open";
  monitor.message(Level::summary, sentence);
}

}  // namespace

PartCad::Parts parts_of(const Model& model) {
  PartCad::Parts parts;
  for (const Face& face : model.faces)
    for (std::size_t c = 0; c < face.curves.size(); ++c)
      if (const FaceCurve& curve = face.curves[c]; curve.part_of != 0)
        parts[{face.ref, static_cast<int>(c) + 1}] = {curve.part_of, curve.part_a, curve.part_b};
  return parts;
}

Model find_references(const Model& model, ModelSupports& supports, Cad& cad, const Gluing& options,
                      std::vector<std::string>& remarks, GlueReport& report, Monitor& monitor) {
  Model cut = model;
  const auto count_curves = [](const Model& m) {
    std::size_t n = 0;
    for (const Face& face : m.faces) n += face.curves.size();
    return n;
  };
  for (int round = 0; round < max_rounds && cut_once(cut, supports, cad, options, monitor); ++round) {
  }
  report = {};
  Model glued = glue(cut, traces_of(supports), options.eps, &remarks, &report, options.eps_open, options.eps_face);
  tell(glued, report, count_curves(cut) - count_curves(model), monitor);
  return glued;
}

void find_references_of_geometries(Model& model, ModelSupports& supports, Cad& cad, const Gluing& options,
                                   std::vector<std::string>& remarks, GlueReport& report, Monitor& monitor) {
  if (!is_mixed(model)) return;
  for (const int geometry : geometries_to_glue(model)) {
    GeometryPart part = part_of(model, geometry);
    ModelSupports own{.of_face = {}, .diag = supports.diag};
    for (const std::size_t face : part.faces) own.of_face.push_back(std::move(supports.of_face[face]));
    GlueReport found;
    const Gluing each{.eps = options.eps, .eps_open = 0, .eps_face = options.eps_face, .angle_smo = options.angle_smo};
    part.model = find_references(part.model, own, cad, each, remarks, found, monitor);
    put_back(part, geometry, model);
    for (std::size_t f = 0; f < part.faces.size(); ++f) supports.of_face[part.faces[f]] = std::move(own.of_face[f]);
    const auto in_whole = [&](GlueReport::Place place) {
      place.face = part.faces[place.face];
      return place;
    };
    for (const GlueReport::Pair& pair : found.pairs)
      report.pairs.push_back({in_whole(pair.a), in_whole(pair.b), pair.gap});
    for (const GlueReport::Place& place : found.open) report.open.push_back(in_whole(place));
  }
}

namespace {

/// An imposed point is on a curve within this share of diag: twice the last digit of five.
constexpr double on_curve_share = 2e-5;
/// In (u, v) it is near that curve, as a share of the domain: other curves may have the same place in space.
constexpr double near_curve_share = 1e-3;

/// The parameter of the nearest place of a polyline.
struct Nearest {
  double distance = infinity, t = 0;
};
template <typename V>
Nearest nearest_on(const std::vector<V>& points, const std::vector<double>& t, const V& p) {
  Nearest best;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const V d = points[i + 1] - points[i];
    const double square = dot(d, d), along = square > 0 ? std::clamp(dot(p - points[i], d) / square, 0., 1.) : 0;
    const double distance = norm(p - lerp(points[i], points[i + 1], along));
    if (distance < best.distance) best = {distance, t[i] + along * (t[i + 1] - t[i])};
  }
  return best;
}

/// Cuts the curves of a model at imposed points that lie on them.
class PointsOnCurves {
 public:
  PointsOnCurves(Model& model, ModelSupports& supports, Cad& host, const Gluing& options, Monitor& monitor)
      : model_(model), supports_(supports), host_(host), options_(options), monitor_(monitor), known_(!needs_gluing(model)) {}

  std::vector<PointOnCurve> run() {
    for (std::size_t f = 0; f < model_.faces.size(); ++f) {
      const Face& face = model_.faces[f];
      if (face.is_wire() || face.discrete || !face.left_out.empty()) continue;
      for (std::size_t k = 0; k < model_.faces[f].points.size();)
        if (!put(f, model_.faces[f].points[k]))
          ++k;
        else
          model_.faces[f].points.erase(model_.faces[f].points.begin() + static_cast<std::ptrdiff_t>(k));
    }
    return std::move(put_);
  }

 private:
  struct Use {
    std::size_t face, curve;
    CurvePoint foot;
  };

  [[nodiscard]] const CurveSupport& support(std::size_t f, std::size_t c) const { return supports_.of_face[f][c]; }

  Use use_of(std::size_t f, std::size_t c, double guess, const Vec3& xyz) {
    PartCad cad(host_, parts_of(model_));
    const CurveSupport& along = support(f, c);
    return {f, c, refine_t(cad, model_.faces[f].ref, static_cast<int>(c) + 1, along, guess, along.t.front(), along.t.back(), xyz)};
  }

  [[nodiscard]] bool at_end(const Use& use) const {
    const std::vector<Vec3>& xyz = support(use.face, use.curve).xyz;
    return std::min(norm(use.foot.xyz - xyz.front()), norm(use.foot.xyz - xyz.back())) <= (known_ ? eps_ : std::max(eps_, options_.eps));
  }

  // False if the point is on no curve that can be cut.
  bool put(std::size_t f, const FacePoint point) {
    std::size_t curve = 0;
    Nearest near;
    Vec2 low{infinity, infinity}, high{-infinity, -infinity};
    for (std::size_t c = 0; c < supports_.of_face[f].size(); ++c) {
      for (const Vec2& p : support(f, c).uv) low = low.cwiseMin(p), high = high.cwiseMax(p);
      if (!(support(f, c).length() > eps_) || model_.faces[f].curves[c].edges) continue;
      const Nearest here = nearest_on(support(f, c).uv, support(f, c).t, point.uv);
      if (here.distance < near.distance) near = here, curve = c;
    }
    const double reach = near_curve_share * norm(high - low);
    if (!(near.distance <= reach)) return false;
    monitor_.checkpoint();
    SurfaceJet jet;
    PartCad(host_, parts_of(model_)).surface(model_.faces[f].ref, want_position, {&point.uv, 1}, {&jet, 1});
    const Use own = use_of(f, curve, near.t, jet.s);
    if (!(own.foot.distance <= eps_) || !(norm(own.foot.uv - point.uv) <= reach)) return false;
    return at_end(own) || cut_at(own, jet.s, point.ref);
  }

  // The other curves that are cut with it: all of its reference, or, if references are sought, all of its face that pass there.
  std::vector<Use> uses_with(const Use& own, const Vec3& xyz) {
    std::vector<Use> uses{own};
    const int ref = model_.faces[own.face].curves[own.curve].ref;
    for (std::size_t f = 0; f < model_.faces.size(); ++f)
      for (std::size_t c = 0; c < supports_.of_face[f].size(); ++c) {
        if ((f == own.face && c == own.curve) || (known_ ? model_.faces[f].curves[c].ref != ref : f != own.face)) continue;
        const Nearest near = nearest_on(support(f, c).xyz, support(f, c).t, xyz);
        if (!known_ && near.distance > 10 * eps_) continue;
        const Use use = use_of(f, c, near.t, xyz);
        if (known_ || (use.foot.distance <= eps_ && !at_end(use))) uses.push_back(use);
      }
    return uses;
  }

  bool cut_at(const Use& own, const Vec3& xyz, int ref) {
    const std::vector<Use> uses = uses_with(own, xyz);
    std::vector<CurveCut> cuts;
    for (const Use& use : uses) {
      const std::vector<double>& t = support(use.face, use.curve).t;
      if (!(use.foot.t > t.front() && use.foot.t < t.back()) || model_.faces[use.face].curves[use.curve].edges) return false;
      cuts.push_back({use.face, use.curve, t.front(), t.back(), {use.foot.t}});
    }
    std::vector<char> along;
    for (const Use& use : uses) along.push_back(runs_along(own, use) ? 1 : 0);
    std::vector<std::size_t> behind;  // curves of the face of each use, and the parts before its own
    std::map<std::size_t, std::size_t> size;
    for (const Use& use : uses) behind.push_back(size.try_emplace(use.face, model_.faces[use.face].curves.size()).first->second++);
    const int whole = host_rank(model_.faces[own.face], own.curve);
    apply_cuts(model_, supports_, host_, cuts, options_.angle_smo, monitor_);
    if (known_)
      share_references(uses, along, behind, ref);
    else
      put_.push_back({own.face, whole, own.foot.t, ref});
    return true;
  }

  // True if a use runs in the direction of the first use: references at the ends decide, or shapes if these are equal.
  [[nodiscard]] bool runs_along(const Use& own, const Use& use) const {
    const FaceCurve &a = model_.faces[own.face].curves[own.curve], &b = model_.faces[use.face].curves[use.curve];
    if (a.end1 != a.end2) return a.end1 == b.end1;
    const CurveSupport &p = support(own.face, own.curve), &q = support(use.face, use.curve);
    const Vec3 quarter = p.point_at_arc(p.length() / 4);
    return norm(quarter - q.point_at_arc(q.length() / 4)) <= norm(quarter - q.point_at_arc(3 * q.length() / 4));
  }

  // Gives both parts of all uses, and the point between them, the references of the first use.
  void share_references(const std::vector<Use>& uses, const std::vector<char>& along, const std::vector<std::size_t>& behind, int ref) {
    const bool named = ref > 0 && !has_corner(model_, ref);
    FaceCurve& first = model_.faces[uses[0].face].curves[uses[0].curve];
    FaceCurve& last = model_.faces[uses[0].face].curves[behind[0]];
    const int fresh = first.end2, middle = named ? ref : fresh, of_first = first.ref, of_last = last.ref;
    const int shown = first.shown_as != 0 ? first.shown_as : first.ref;
    if (!named && ref > 0) model_.shown_points[middle] = ref;
    for (std::size_t i = 0; i < uses.size(); ++i) {
      FaceCurve& front = model_.faces[uses[i].face].curves[uses[i].curve];
      FaceCurve& back = model_.faces[uses[i].face].curves[behind[i]];
      front.ref = along[i] != 0 ? of_first : of_last;
      back.ref = along[i] != 0 ? of_last : of_first;
      front.end2 = back.end1 = middle;
      front.shown_as = back.shown_as = shown;
    }
  }

  Model& model_;
  ModelSupports& supports_;
  Cad& host_;
  const Gluing& options_;
  Monitor& monitor_;
  bool known_;  // the model has references
  double eps_ = on_curve_share * supports_.diag;
  std::vector<PointOnCurve> put_;
};

}  // namespace

bool has_corner(const Model& model, int ref) {
  for (const Face& face : model.faces)
    for (const FaceCurve& curve : face.curves)
      if (curve.end1 == ref || curve.end2 == ref) return true;
  return false;
}

std::vector<PointOnCurve> put_points_on_curves(Model& model, ModelSupports& supports, Cad& host, const Gluing& options,
                                               Monitor& monitor) {
  return PointsOnCurves(model, supports, host, options, monitor).run();
}

void name_points_on_curves(Model& model, const std::vector<PointOnCurve>& points) {
  for (const PointOnCurve& point : points) {
    const std::vector<FaceCurve>& curves = model.faces[point.face].curves;
    const auto part = std::find_if(curves.begin(), curves.end(), [&](const FaceCurve& curve) {
      return curve.part_of == point.curve && curve.part_b == point.t;
    });
    if (part == curves.end() || point.ref <= 0) continue;
    const int found = part->end2;
    if (found == point.ref) continue;
    if (has_corner(model, point.ref)) {
      model.shown_points[found] = point.ref;
      continue;
    }
    for (Face& face : model.faces)
      for (FaceCurve& curve : face.curves)
        for (int* end : {&curve.end1, &curve.end2})
          if (*end == found) *end = point.ref;
  }
}

std::vector<Interface> list_interfaces(const Model& model, const Topology& topology, const std::vector<CurveGap>& gaps,
                                       const GlueReport& report) {
  const auto place = [&](const CurveUse& use) {
    const Face& face = model.faces[static_cast<std::size_t>(use.face)];
    return Where{.face = face.ref, .curve_index = host_rank(face, static_cast<std::size_t>(use.curve))};
  };
  std::vector<Interface> interfaces;
  for (std::size_t c = 0; c < topology.curves.size(); ++c) {
    const Curve& curve = topology.curves[c];
    Interface entry{.ref = curve.ref,
                    .uses = static_cast<int>(curve.uses.size()),
                    .first = place(curve.uses.front()),
                    .farthest = place(curve.uses[static_cast<std::size_t>(gaps[c].use)]),
                    .degenerate = curve.degenerate,
                    .gap = gaps[c].gap};
    entry.loose = std::all_of(curve.uses.begin(), curve.uses.end(), [&](const CurveUse& use) {
      return model.faces[static_cast<std::size_t>(use.face)].is_wire();
    });
    for (const CurveUse& use : curve.uses)
      if (model.faces[static_cast<std::size_t>(use.face)].curves[static_cast<std::size_t>(use.curve)].type ==
          CurveType::boundary)
        entry.boundary = true;
    // Without a gap the other use is as good as any.
    if (gaps[c].use == 0 && curve.uses.size() > 1) entry.farthest = place(curve.uses[1]);
    interfaces.push_back(entry);
  }
  for (const GlueReport::Pair& pair : report.pairs) {
    // A face that was left out since has no curves.
    const GlueReport::Place& known = model.faces[pair.a.face].curves.empty() ? pair.b : pair.a;
    if (model.faces[known.face].curves.empty()) continue;
    Interface& entry = interfaces[static_cast<std::size_t>(topology.curve_of[known.face][known.curve])];
    entry.glued = true;
    entry.gap = std::max(entry.gap, pair.gap);
  }
  return interfaces;
}

void tell_interfaces(const std::vector<Interface>& interfaces, Monitor& monitor) {
  std::size_t open = 0, crowded = 0, loose = 0;
  const Interface* widest = nullptr;
  for (const Interface& entry : interfaces) {
    if (entry.degenerate) continue;
    open += entry.boundary && entry.uses == 1 ? 1 : 0;
    crowded += entry.uses > 2 ? 1 : 0;
    loose += entry.loose ? 1 : 0;
    if (widest == nullptr || entry.gap > widest->gap) widest = &entry;
  }
  std::string sentence =
      count_of(interfaces.size(), "curve", "curves") + " in space, " + std::to_string(open) + " open";
  if (loose > 0) sentence += ", " + std::to_string(loose) + " of no face";
  if (crowded > 0) sentence += ", " + std::to_string(crowded) + " with more than two uses";
  if (widest != nullptr && widest->gap > 0)
    sentence += "; the widest gap is " + short_number(widest->gap) + ", at curve " + std::to_string(widest->ref) +
                " (face " + std::to_string(widest->first.face) + " curve " + std::to_string(widest->first.curve_index) +
                ", face " + std::to_string(widest->farthest.face) + " curve " +
                std::to_string(widest->farthest.curve_index) + ")";
  monitor.message(Level::summary, sentence);
}

}  // namespace carreau
