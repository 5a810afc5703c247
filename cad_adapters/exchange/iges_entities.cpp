// SPDX-License-Identifier: BSD-3-Clause
#include "iges_entities.h"

#include <IGESBasic_SingularSubfigure.hxx>
#include <IGESGeom_BSplineCurve.hxx>
#include <IGESGeom_BSplineSurface.hxx>
#include <IGESGeom_BoundedSurface.hxx>
#include <IGESGeom_TrimmedSurface.hxx>
#include <IGESSolid_Face.hxx>
#include <algorithm>
#include <iterator>
#include <utility>

namespace carreau_occ {

bool IgesEntities::is_face(const Entity& entity) const {
  return is<IGESSolid_Face>(entity) || is<IGESGeom_TrimmedSurface>(entity) || is<IGESGeom_BoundedSurface>(entity);
}

bool IgesEntities::is_geometry(const Entity& entity) const { return is<IGESData_IGESEntity>(entity); }

/// Copious data, curves, points, flashes and all of annotation and structure carry none.
bool IgesEntities::carries_faces(const Entity& entity, const Interface_Graph&) const {
  const auto iges = Handle(IGESData_IGESEntity)::DownCast(entity);
  const int type = iges.IsNull() ? 0 : iges->TypeNumber();
  constexpr int surfaces[] = {108, 114, 118, 120, 122, 124, 128, 140, 143, 144, 308, 408};
  const bool solid = type >= 150 && type <= 198, boundary = type >= 502 && type <= 514;
  return solid || boundary || std::find(std::begin(surfaces), std::end(surfaces), type) != std::end(surfaces);
}

// Knots of IGES count from minus the degree, poles from zero.
Spline IgesEntities::spline(const Entity& entity) const {
  Spline spline;
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
  return spline;
}

std::string IgesEntities::lost_scale(const Entity& entity) const {
  const auto instance = Handle(IGESBasic_SingularSubfigure)::DownCast(entity);
  if (instance.IsNull() || !instance->HasScaleFactor() || instance->ScaleFactor() == 1) return "";
  return "an instance with the scale " + printed(instance->ScaleFactor()) + " is not placed";
}

}  // namespace carreau_occ
