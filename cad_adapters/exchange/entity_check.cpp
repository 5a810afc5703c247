// SPDX-License-Identifier: BSD-3-Clause
#include "entity_check.h"

#include <Interface_Check.hxx>
#include <Interface_CheckIterator.hxx>
#include <Interface_EntityIterator.hxx>
#include <Interface_Graph.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <algorithm>
#include <set>
#include <sstream>

#include "face_check.h"

namespace carreau_occ {
namespace {

/// Absurd values in readable numbers; "": none.
std::string nonsense(const Spline& spline) {
  for (const std::vector<double>& knots : spline.knots)
    if (!std::all_of(knots.begin(), knots.end(), usable) || !std::is_sorted(knots.begin(), knots.end()))
      return "its knots do not ascend, or reach beyond 1e15";
  if (!std::all_of(spline.weights.begin(), spline.weights.end(), [](double w) { return w > 0 && usable(w); }))
    return "its weights are not all positive, or reach beyond 1e15";
  if (!std::all_of(spline.coordinates.begin(), spline.coordinates.end(), usable))
    return "a pole is not finite or beyond 1e15";
  return "";
}

/// OpenCASCADE takes a default for an unknown word, and an empty text for a missing one; other errors leave something
/// unset.
bool is_harmless(const std::string& error) {
  return error.find("numeration") != std::string::npos || error.find("not a quoted String") != std::string::npos;
}

std::string error_of(const Handle(Interface_Check) & check) {
  for (int i = 1; i <= check->NbFails(); ++i)
    if (const std::string error = check->CFail(i); !is_harmless(error))
      return error.substr(error.find_first_not_of(' '));
  return "";
}

/// The longest meaningful type of a STEP entity with several types, "(A,B,C)".
std::string type_of(std::string name) {
  if (name.empty() || name.front() != '(') return name;
  std::string longest;
  std::istringstream types(name.substr(1, name.size() - 2));
  while (std::getline(types, name, ','))
    if (name.size() > longest.size() && name != "GEOMETRIC_REPRESENTATION_ITEM") longest = name;
  return longest;
}

}  // namespace

EntityCheck::EntityCheck(const Handle(XSControl_WorkSession) & session, const EntityKinds& kinds)
    : session_(session), model_(session->Model()), kinds_(kinds) {
  if (model_.IsNull()) return;
  session_->ComputeGraph();
  find_errors();
  std::set<Entity> bad;
  for (const auto& [number, why] : faces_) bad.insert(model_->Value(number));
  if (!bad.empty()) kinds_.take_out(model_, bad);
}

std::string EntityCheck::label(const Entity& entity) const {
  const Handle(TCollection_HAsciiString) number = model_->StringLabel(entity);
  return std::string(number.IsNull() ? "?" : number->ToCString()) + " " +
         type_of(model_->TypeName(entity, Standard_False));
}

void EntityCheck::find_errors() {
  for (int i = 1; i <= model_->NbEntities(); ++i) {
    const Entity entity = model_->Value(i);
    std::string why = error_of(model_->Check(i, Standard_True));
    if (kinds_.mend_numbers(entity))
      why += std::string(why.empty() ? "" : "; ") + "a number is not finite or beyond 1e15";
    if (why.empty()) why = nonsense(kinds_.spline(entity));
    if (!why.empty() && kinds_.is_geometry(entity)) blame(i, label(entity) + ": " + why, faces_, rest_);
  }
}

/// Gives the error of an entity to the faces that it is a part of; without such faces the entity has it itself.
void EntityCheck::blame(int number, const std::string& why, std::map<int, std::string>& faces,
                        std::map<int, std::string>& rest) const {
  const Interface_Graph& graph = session_->Graph();
  std::set<int> seen{number};
  std::vector<int> open{number};
  bool found = false;
  while (!open.empty()) {
    const int each = open.back();
    open.pop_back();
    const Entity entity = model_->Value(each);
    if (kinds_.is_face(entity)) {
      faces.emplace(each, why);
      found = true;
      continue;
    }
    for (const Entity& whole : kinds_.wholes_of(entity, graph))
      if (const int above = model_->Number(whole); above > 0 && kinds_.is_geometry(whole) && seen.insert(above).second)
        open.push_back(above);
  }
  if (!found) rest.emplace(number, why);
}

/// Entities with an error that no face has, including errors of the translation. `faces` gets faces with errors of the
/// translation.
std::map<int, std::string> EntityCheck::errors_beside_faces(std::map<int, std::string>& faces) const {
  std::map<int, std::string> rest = rest_;
  const Handle(Transfer_TransientProcess) process = session_->TransferReader()->TransientProcess();
  Interface_CheckIterator errors = process->CheckList(Standard_True);
  for (errors.Start(); errors.More(); errors.Next())
    if (const std::string why = error_of(errors.Value()); !why.empty() && errors.Number() > 0)
      blame(errors.Number(), label(model_->Value(errors.Number())) + ": " + why, faces, rest);
  return rest;
}

/// The entity, or one of which it is a part, carries faces. Representations hold faces and texts alike.
bool EntityCheck::carries_faces(int number) const {
  const Interface_Graph& graph = session_->Graph();
  std::set<int> seen{number};
  std::vector<int> open{number};
  while (!open.empty()) {
    const Entity entity = model_->Value(open.back());
    open.pop_back();
    if (kinds_.carries_faces(entity, graph)) return true;
    for (const Entity& whole : kinds_.wholes_of(entity, graph))
      if (const int above = model_->Number(whole);
          above > 0 && (kinds_.is_geometry(whole) || kinds_.carries_faces(whole, graph)) && seen.insert(above).second)
        open.push_back(above);
  }
  return false;
}

std::string EntityCheck::passed_over() const {
  if (model_.IsNull()) return "";
  constexpr int max_listed = 5;
  std::map<int, std::string> faces;
  std::string list;
  int count = 0;
  for (const auto& [number, why] : errors_beside_faces(faces)) {
    if (carries_faces(number)) continue;
    if (++count <= max_listed) list += (count > 1 ? ", " : "") + label(model_->Value(number));
  }
  if (count == 0) return "";
  return std::to_string(count) +
         (count == 1 ? " entity that carries no face was" : " entities that carry no face were") +
         " not read: " + list + (count > max_listed ? ", ..." : "");
}

std::vector<std::string> EntityCheck::losses() const {
  if (model_.IsNull()) return {};
  std::map<int, std::string> faces = faces_, all = errors_beside_faces(faces);
  std::erase_if(all, [&](const auto& error) { return !carries_faces(error.first); });
  const Handle(Transfer_TransientProcess) process = session_->TransferReader()->TransientProcess();
  for (int i = 1; i <= model_->NbEntities(); ++i) {
    const Entity entity = model_->Value(i);
    if (const std::string why = kinds_.lost_scale(entity); !why.empty()) all.emplace(i, label(entity) + ": " + why);
    if (!kinds_.is_face(entity)) continue;
    const auto found = faces.find(i);
    const bool made = !TransferBRep::ShapeResult(process, entity).IsNull();
    if (found == faces.end() ? made : made && faces_.count(i) != 0) continue;  // whole, or one of doubtful()
    const std::string own = label(entity) + ": ";
    if (found == faces.end())
      all[i] = own + "no shape of the file holds it";
    else
      all[i] = found->second.rfind(own, 0) == 0 ? found->second : own + found->second;
  }
  std::vector<std::string> list;
  for (const auto& [number, sentence] : all) list.push_back(sentence);
  return list;
}

std::vector<std::pair<TopoDS_Shape, std::string>> EntityCheck::doubtful() const {
  std::vector<std::pair<TopoDS_Shape, std::string>> list;
  if (model_.IsNull()) return list;
  const Handle(Transfer_TransientProcess) process = session_->TransferReader()->TransientProcess();
  for (const auto& [number, why] : faces_)
    if (const TopoDS_Shape face = TransferBRep::ShapeResult(process, model_->Value(number)); !face.IsNull())
      list.emplace_back(face, why);
  return list;
}

}  // namespace carreau_occ
