// SPDX-License-Identifier: BSD-3-Clause
#include "session/gluing.h"

#include <algorithm>
#include <map>
#include <utility>

#include "model/geometries.h"
#include "model/places.h"
#include "model/splits.h"
#include "support/format.h"
#include "support/short_number.h"

namespace carreau {
namespace {

// A cut makes new ends, which can lie on further curves.
constexpr int max_rounds = 4;

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

  std::vector<std::size_t> whole;  // curves of each face that were there before
  for (const Face& face : model.faces) whole.push_back(face.curves.size());
  model = cut_curves(model, useful);
  PartCad cut_cad(host, parts_of(model));
  const auto build = [&](std::size_t f, std::size_t c) {
    monitor.checkpoint();
    return build_support(cut_cad, model.faces[f].ref, static_cast<int>(c) + 1, {.angle_deg = options.angle_smo});
  };
  for (const CurveCut& cut : useful) supports.of_face[cut.face][cut.curve] = build(cut.face, cut.curve);
  for (std::size_t f = 0; f < model.faces.size(); ++f)
    for (std::size_t c = whole[f]; c < model.faces[f].curves.size(); ++c) supports.of_face[f].push_back(build(f, c));
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
