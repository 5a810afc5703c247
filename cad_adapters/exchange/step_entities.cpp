// SPDX-License-Identifier: BSD-3-Clause
#include "step_entities.h"

#include <StepGeom_BSplineCurveWithKnots.hxx>
#include <StepGeom_BSplineCurveWithKnotsAndRationalBSplineCurve.hxx>
#include <StepGeom_BSplineSurfaceWithKnots.hxx>
#include <StepGeom_BSplineSurfaceWithKnotsAndRationalBSplineSurface.hxx>
#include <StepGeom_CartesianPoint.hxx>
#include <StepGeom_CartesianTransformationOperator.hxx>
#include <StepGeom_CartesianTransformationOperator3d.hxx>
#include <StepGeom_Direction.hxx>
#include <StepGeom_Pcurve.hxx>
#include <StepGeom_Placement.hxx>
#include <StepGeom_Surface.hxx>
#include <StepRepr_ItemDefinedTransformation.hxx>
#include <StepRepr_MappedItem.hxx>
#include <StepShape_ConnectedFaceSet.hxx>
#include <StepShape_Face.hxx>
#include <StepShape_FaceBasedSurfaceModel.hxx>
#include <StepShape_HArray1OfFace.hxx>
#include <StepShape_ShapeRepresentation.hxx>
#include <StepShape_ShellBasedSurfaceModel.hxx>
#include <StepShape_SolidModel.hxx>
#include <StepShape_TopologicalRepresentationItem.hxx>
#include <StepVisual_AnnotationOccurrence.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TColStd_HArray2OfReal.hxx>
#include <algorithm>

#include "face_check.h"

namespace carreau_occ {
namespace {

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

}  // namespace

bool StepEntities::is_face(const Entity& entity) const { return is<StepShape_Face>(entity); }

bool StepEntities::is_geometry(const Entity& entity) const {
  return is<StepGeom_GeometricRepresentationItem>(entity) || is<StepShape_TopologicalRepresentationItem>(entity);
}

bool StepEntities::carries_faces(const Entity& entity, const Interface_Graph& graph) const {
  if (is<StepShape_Face>(entity) || is<StepShape_ConnectedFaceSet>(entity) || is<StepShape_SolidModel>(entity) ||
      is<StepShape_ShellBasedSurfaceModel>(entity) || is<StepShape_FaceBasedSurfaceModel>(entity) ||
      is<StepGeom_Surface>(entity) || is<StepRepr_ItemDefinedTransformation>(entity) ||
      is<StepGeom_CartesianTransformationOperator>(entity))
    return true;
  if (is<StepRepr_MappedItem>(entity)) return !is<StepVisual_AnnotationOccurrence>(entity);
  if (!is<StepGeom_Placement>(entity)) return false;
  // The axes of a shape, to which assemblies refer.
  return graph.TypedSharings(entity, STANDARD_TYPE(StepShape_ShapeRepresentation)).NbEntities() > 0;
}

Spline StepEntities::spline(const Entity& entity) const {
  Spline spline;
  if (is<StepGeom_BSplineSurface>(entity)) {
    take_surface<StepGeom_BSplineSurfaceWithKnots>(entity, spline);
    take_surface<StepGeom_BSplineSurfaceWithKnotsAndRationalBSplineSurface>(entity, spline);
  } else if (is<StepGeom_BSplineCurve>(entity)) {
    take_curve<StepGeom_BSplineCurveWithKnots>(entity, spline);
    take_curve<StepGeom_BSplineCurveWithKnotsAndRationalBSplineCurve>(entity, spline);
  }
  return spline;
}

bool StepEntities::mend_numbers(const Entity& entity) const {
  const auto point = as<StepGeom_CartesianPoint>(entity);
  const auto vector = point.IsNull() ? as<StepGeom_Direction>(entity) : Handle(StepGeom_Direction)();
  const int n = !point.IsNull() ? point->NbCoordinates() : !vector.IsNull() ? vector->NbDirectionRatios() : 0;
  const auto number = [&](int i) { return point.IsNull() ? vector->DirectionRatiosValue(i) : point->CoordinatesValue(i); };
  int good = 0;
  for (int i = 1; i <= n; ++i) good += usable(number(i)) ? 1 : 0;
  if (good == n) return false;
  const Handle(TColStd_HArray1OfReal) numbers = new TColStd_HArray1OfReal(1, n, 0.);
  for (int i = 1; i <= n; ++i)
    if (usable(number(i))) numbers->SetValue(i, number(i));
  if (point.IsNull())
    vector->SetDirectionRatios(numbers);
  else
    point->SetCoordinates(numbers);
  return true;
}

std::string StepEntities::lost_scale(const Entity& entity) const {
  const auto place = as<StepGeom_CartesianTransformationOperator3d>(entity);
  if (place.IsNull() || !place->HasScale() || place->Scale() == 1) return "";
  return "its scale of " + printed(place->Scale()) + " is not applied: the placed part keeps its size";
}

/// A surface knows the images of edges on it, which belong to the edges. These have sound neighbours: a faulty image is
/// a fault of its surface.
std::vector<Entity> StepEntities::wholes_of(const Entity& entity, const Interface_Graph& graph) const {
  if (const auto image = Handle(StepGeom_Pcurve)::DownCast(entity); !image.IsNull()) return {image->BasisSurface()};
  std::vector<Entity> wholes;
  for (const Entity& whole : EntityKinds::wholes_of(entity, graph)) {
    const auto image = Handle(StepGeom_Pcurve)::DownCast(whole);
    if (image.IsNull() || image->BasisSurface() != entity) wholes.push_back(whole);
  }
  return wholes;
}

void StepEntities::take_out(const Handle(Interface_InterfaceModel) & model, const std::set<Entity>& faces) const {
  for (int i = 1; i <= model->NbEntities() && !faces.empty(); ++i) {
    const auto shell = Handle(StepShape_ConnectedFaceSet)::DownCast(model->Value(i));
    if (shell.IsNull() || shell->CfsFaces().IsNull()) continue;
    std::vector<Handle(StepShape_Face)> good;
    for (const Handle(StepShape_Face) & face : *shell->CfsFaces())
      if (faces.count(face) == 0) good.push_back(face);
    // Arrays of OpenCASCADE are never empty: a shell without a good face stays as it is.
    if (good.empty() || static_cast<int>(good.size()) == shell->NbCfsFaces()) continue;
    const Handle(StepShape_HArray1OfFace) left = new StepShape_HArray1OfFace(1, static_cast<int>(good.size()));
    std::copy(good.begin(), good.end(), left->begin());
    shell->SetCfsFaces(left);
  }
}

}  // namespace carreau_occ
