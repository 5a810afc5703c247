// SPDX-License-Identifier: BSD-3-Clause
#include "entity_check.h"

#include <IGESBasic_SingularSubfigure.hxx>
#include <IGESGeom_BSplineCurve.hxx>
#include <IGESGeom_BSplineSurface.hxx>
#include <IGESGeom_BoundedSurface.hxx>
#include <IGESGeom_TrimmedSurface.hxx>
#include <IGESSolid_Face.hxx>
#include <Interface_Check.hxx>
#include <Interface_CheckIterator.hxx>
#include <Interface_EntityIterator.hxx>
#include <Interface_Graph.hxx>
#include <StepGeom_BSplineCurveWithKnots.hxx>
#include <StepGeom_BSplineCurveWithKnotsAndRationalBSplineCurve.hxx>
#include <StepGeom_BSplineSurfaceWithKnots.hxx>
#include <StepGeom_BSplineSurfaceWithKnotsAndRationalBSplineSurface.hxx>
#include <StepGeom_CartesianPoint.hxx>
#include <StepGeom_CartesianTransformationOperator3d.hxx>
#include <StepGeom_Direction.hxx>
#include <StepGeom_Pcurve.hxx>
#include <StepGeom_Surface.hxx>
#include <StepShape_ConnectedFaceSet.hxx>
#include <StepShape_Face.hxx>
#include <StepShape_HArray1OfFace.hxx>
#include <StepShape_TopologicalRepresentationItem.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TColStd_HArray2OfReal.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <algorithm>
#include <gp_Pnt.hxx>
#include <set>
#include <sstream>

#include "face_check.h"

namespace carreau_occ {
namespace {

using Entity = Handle(Standard_Transient);

template <typename Type>
bool is(const Entity& entity) {
  return entity->IsKind(STANDARD_TYPE(Type));
}

bool is_face(const Entity& entity) {
  return is<StepShape_Face>(entity) || is<IGESSolid_Face>(entity) || is<IGESGeom_TrimmedSurface>(entity) ||
         is<IGESGeom_BoundedSurface>(entity);
}

/// Entities of which a shape is made. What else a file holds (styles, notes, persons) may be wrong.
bool is_geometry(const Entity& entity) {
  return is<StepGeom_GeometricRepresentationItem>(entity) || is<StepShape_TopologicalRepresentationItem>(entity) ||
         is<IGESData_IGESEntity>(entity);
}

/// The numbers of a spline, where there are some.
struct Spline {
  std::vector<std::vector<double>> knots;
  std::vector<double> weights, coordinates;

  void add_knots(const Handle(TColStd_HArray1OfReal) & array) {
    if (!array.IsNull()) knots.emplace_back(array->begin(), array->end());
  }
  void add(const gp_Pnt& p, double weight) {
    coordinates.insert(coordinates.end(), {p.X(), p.Y(), p.Z()});
    weights.push_back(weight);
  }
};

template <typename Curve>
void take_curve(const Entity& entity, Spline& spline) {
  if (const auto curve = Handle(Curve)::DownCast(entity); !curve.IsNull()) {
    spline.add_knots(curve->Knots());
    if constexpr (requires { curve->WeightsData(); })
      if (const auto weights = curve->WeightsData(); !weights.IsNull())
        spline.weights.assign(weights->begin(), weights->end());
  }
}

template <typename Surface>
void take_surface(const Entity& entity, Spline& spline) {
  if (const auto surface = Handle(Surface)::DownCast(entity); !surface.IsNull()) {
    spline.add_knots(surface->UKnots());
    spline.add_knots(surface->VKnots());
    if constexpr (requires { surface->WeightsData(); })
      if (const auto weights = surface->WeightsData(); !weights.IsNull())
        for (int i = weights->LowerRow(); i <= weights->UpperRow(); ++i)
          for (int j = weights->LowerCol(); j <= weights->UpperCol(); ++j)
            spline.weights.push_back(weights->Value(i, j));
  }
}

// Knots of IGES count from minus the degree, poles from zero.
void take_iges(const Entity& entity, Spline& spline) {
  if (const auto curve = Handle(IGESGeom_BSplineCurve)::DownCast(entity); !curve.IsNull()) {
    auto& knots = spline.knots.emplace_back();
    for (int i = 0; i < curve->NbKnots(); ++i) knots.push_back(curve->Knot(i - curve->Degree()));
    for (int i = 0; i < curve->NbPoles(); ++i) spline.add(curve->Pole(i), curve->Weight(i));
  }
  if (const auto surface = Handle(IGESGeom_BSplineSurface)::DownCast(entity); !surface.IsNull()) {
    std::vector<double> u, v;
    for (int i = 0; i < surface->NbKnotsU(); ++i) u.push_back(surface->KnotU(i - surface->DegreeU()));
    for (int i = 0; i < surface->NbKnotsV(); ++i) v.push_back(surface->KnotV(i - surface->DegreeV()));
    spline.knots = {std::move(u), std::move(v)};
    for (int i = 0; i < surface->NbPolesU(); ++i)
      for (int j = 0; j < surface->NbPolesV(); ++j) spline.add(surface->Pole(i, j), surface->Weight(i, j));
  }
}

/// What makes no sense in numbers that can be read; "" when nothing does.
std::string nonsense(const Entity& entity) {
  Spline spline;
  take_surface<StepGeom_BSplineSurfaceWithKnots>(entity, spline);
  take_surface<StepGeom_BSplineSurfaceWithKnotsAndRationalBSplineSurface>(entity, spline);
  take_curve<StepGeom_BSplineCurveWithKnots>(entity, spline);
  take_curve<StepGeom_BSplineCurveWithKnotsAndRationalBSplineCurve>(entity, spline);
  take_iges(entity, spline);
  for (const std::vector<double>& knots : spline.knots)
    if (!std::all_of(knots.begin(), knots.end(), usable) || !std::is_sorted(knots.begin(), knots.end()))
      return "its knots do not ascend, or reach beyond 1e15";
  if (!std::all_of(spline.weights.begin(), spline.weights.end(), [](double w) { return w > 0 && usable(w); }))
    return "its weights are not all positive, or reach beyond 1e15";
  if (!std::all_of(spline.coordinates.begin(), spline.coordinates.end(), usable))
    return "a pole is not finite or beyond 1e15";
  return "";
}

/// Numbers that could not be read hold anything, and OpenCASCADE searches without end where coordinates are not finite.
bool mend_numbers(const Entity& entity) {
  const auto point = Handle(StepGeom_CartesianPoint)::DownCast(entity);
  const auto vector = Handle(StepGeom_Direction)::DownCast(entity);
  const int n = !point.IsNull() ? point->NbCoordinates() : !vector.IsNull() ? vector->NbDirectionRatios() : 0;
  if (n < 1) return false;
  const Handle(TColStd_HArray1OfReal) numbers = new TColStd_HArray1OfReal(1, n, 0.);
  bool good = true;
  for (int i = 1; i <= n; ++i) {
    const double x = point.IsNull() ? vector->DirectionRatiosValue(i) : point->CoordinatesValue(i);
    if (usable(x))
      numbers->SetValue(i, x);
    else
      good = false;
  }
  if (good) return false;
  if (point.IsNull())
    vector->SetDirectionRatios(numbers);
  else
    point->SetCoordinates(numbers);
  return true;
}

/// OpenCASCADE takes a default where it does not know a word; all else leaves something unset.
bool is_word(const std::string& error) { return error.find("numeration") != std::string::npos; }

std::string error_of(const Handle(Interface_Check) & check) {
  for (int i = 1; i <= check->NbFails(); ++i)
    if (const std::string error = check->CFail(i); !is_word(error)) return error.substr(error.find_first_not_of(' '));
  return "";
}

/// Of a STEP entity with several types, "(A,B,C)", the longest that says something.
std::string type_of(std::string name) {
  if (name.empty() || name.front() != '(') return name;
  std::string longest;
  std::istringstream types(name.substr(1, name.size() - 2));
  while (std::getline(types, name, ','))
    if (name.size() > longest.size() && name != "GEOMETRIC_REPRESENTATION_ITEM") longest = name;
  return longest;
}

std::string number(double x) {
  std::ostringstream text;
  text << x;
  return text.str();
}

/// What OpenCASCADE 7.6 does not do with a placement that scales; "" for all other entities.
std::string lost_scale(const Entity& entity) {
  if (const auto place = Handle(StepGeom_CartesianTransformationOperator3d)::DownCast(entity);
      !place.IsNull() && place->HasScale() && place->Scale() != 1)
    return "its scale of " + number(place->Scale()) + " is not applied: what it places has the size of its part";
  if (const auto instance = Handle(IGESBasic_SingularSubfigure)::DownCast(entity);
      !instance.IsNull() && instance->HasScaleFactor() && instance->ScaleFactor() != 1)
    return "an instance with the scale " + number(instance->ScaleFactor()) + " is not placed";
  return "";
}

/// Entities of which a faulty one is a part. A surface knows the images of edges on it, which belong to the edges:
/// those have neighbours that are sound; a faulty image is a fault of its surface.
std::vector<Entity> wholes_of(const Entity& entity, const Interface_Graph& graph) {
  if (const auto image = Handle(StepGeom_Pcurve)::DownCast(entity); !image.IsNull()) return {image->BasisSurface()};
  std::vector<Entity> wholes;
  for (Interface_EntityIterator up = graph.Sharings(entity); up.More(); up.Next()) {
    const auto image = Handle(StepGeom_Pcurve)::DownCast(up.Value());
    if (image.IsNull() || image->BasisSurface() != entity) wholes.push_back(up.Value());
  }
  return wholes;
}

}  // namespace

EntityCheck::EntityCheck(const Handle(XSControl_WorkSession) & session) : session_(session), model_(session->Model()) {
  if (model_.IsNull()) return;
  session_->ComputeGraph();
  find_errors();
  take_out_of_shells();
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
    if (mend_numbers(entity)) why += std::string(why.empty() ? "" : "; ") + "a number is not finite or beyond 1e15";
    if (why.empty()) why = nonsense(entity);
    if (!why.empty() && is_geometry(entity)) blame(i, label(entity) + ": " + why, faces_, rest_);
  }
}

/// The faces that an entity is a part of have its error; if there is none, it has it itself.
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
    if (is_face(entity)) {
      faces.emplace(each, why);
      found = true;
      continue;
    }
    for (const Entity& whole : wholes_of(entity, graph))
      if (const int above = model_->Number(whole); above > 0 && is_geometry(whole) && seen.insert(above).second)
        open.push_back(above);
  }
  if (!found) rest.emplace(number, why);
}

void EntityCheck::take_out_of_shells() const {
  std::set<Entity> bad;
  for (const auto& [number, why] : faces_) bad.insert(model_->Value(number));
  for (int i = 1; i <= model_->NbEntities() && !bad.empty(); ++i) {
    const auto shell = Handle(StepShape_ConnectedFaceSet)::DownCast(model_->Value(i));
    if (shell.IsNull() || shell->CfsFaces().IsNull()) continue;
    std::vector<Handle(StepShape_Face)> good;
    for (const Handle(StepShape_Face) & face : *shell->CfsFaces())
      if (bad.count(face) == 0) good.push_back(face);
    // Arrays of OpenCASCADE are never empty: of a shell without a good face the translation makes what it can.
    if (good.empty() || static_cast<int>(good.size()) == shell->NbCfsFaces()) continue;
    const Handle(StepShape_HArray1OfFace) left = new StepShape_HArray1OfFace(1, static_cast<int>(good.size()));
    std::copy(good.begin(), good.end(), left->begin());
    shell->SetCfsFaces(left);
  }
}

std::vector<std::string> EntityCheck::losses() const {
  if (model_.IsNull()) return {};
  std::map<int, std::string> faces = faces_, all = rest_;
  const Handle(Transfer_TransientProcess) process = session_->TransferReader()->TransientProcess();
  Interface_CheckIterator errors = process->CheckList(Standard_True);
  for (errors.Start(); errors.More(); errors.Next())
    if (const std::string why = error_of(errors.Value()); !why.empty() && errors.Number() > 0)
      blame(errors.Number(), label(model_->Value(errors.Number())) + ": " + why, faces, all);
  for (int i = 1; i <= model_->NbEntities(); ++i) {
    const Entity entity = model_->Value(i);
    if (const std::string why = lost_scale(entity); !why.empty()) all.emplace(i, label(entity) + ": " + why);
    if (!is_face(entity)) continue;
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
