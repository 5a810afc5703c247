// SPDX-License-Identifier: BSD-3-Clause
#include "session/left_out.h"

#include <algorithm>

#include "cad/part_cad.h"
#include "model/topology.h"
#include "periodic/invalid_periodicity.h"
#include "session/gluing.h"
#include "session/options.h"

namespace carreau {

namespace {

bool leave_out(Model& model, const Where& where, const std::string& sentence) {
  if (where.face == 0) return false;
  const auto face = std::find_if(model.faces.begin(), model.faces.end(),
                                 [&](const Face& f) { return f.ref == where.face && f.left_out.empty(); });
  if (face == model.faces.end()) return false;
  face->left_out = sentence;
  return true;
}

}  // namespace

bool leave_out(Model& model, const Error& error) {
  const bool of_a_face =
      dynamic_cast<const CallbackError*>(&error) != nullptr || dynamic_cast<const InvalidModel*>(&error) != nullptr;
  return of_a_face && dynamic_cast<const InvalidPeriodicity*>(&error) == nullptr && leave_out(model, error.where(), error.what());
}

// Curves share rules: without one face the other faces may break none, or a different one.
void leave_out_defects(Model& model) {
  for (;;) {
    const std::vector<ModelDefect> defects = list_model_defects(model);
    if (defects.empty()) return;
    bool any = false;
    for (const ModelDefect& defect : defects) any |= leave_out(model, defect.where, defect.text());
    if (!any) throw InvalidModel(defects.front().where, defects.front().sentence);
  }
}

std::string reason_of(int face, const std::string& why) {
  return why.starts_with("face ") ? why : Where{.face = face}.prefix() + why;
}

Model without_left_out(const Model& model) {
  Model part = model;
  for (Face& face : part.faces)
    if (!face.left_out.empty()) face.curves.clear(), face.points.clear();
  return part;
}

std::pair<Model, ModelSupports> supports_of(Model& known, Cad& whole_cad, double angle_smo,
                                            const Parameters& parameters, Monitor& monitor) {
  for (;;) {
    Model given = without_left_out(known);
    if (std::none_of(given.faces.begin(), given.faces.end(), [](const Face& face) { return face.left_out.empty(); }))
      throw DomainError("no face could be meshed: " + reason_of(given.faces.front().ref, given.faces.front().left_out));
    PartCad cad(whole_cad, parts_of(given));
    std::vector<std::string> failures;
    ModelSupports supports = build_supports(given, cad, angle_smo, threads_of(parameters), monitor,
                                            leaves_out(parameters) ? &failures : nullptr);
    bool complete = true;
    for (std::size_t f = 0; f < failures.size(); ++f)
      if (!failures[f].empty()) known.faces[f].left_out = failures[f], complete = false;
    if (complete) return {std::move(given), std::move(supports)};
  }
}

void give_back(const Model& whole, Model& part) {
  for (std::size_t f = 0; f < part.faces.size(); ++f) {
    if (part.faces[f].left_out.empty()) continue;
    part.faces[f].curves = whole.faces[f].curves;
    part.faces[f].points = whole.faces[f].points;
  }
}

}  // namespace carreau
