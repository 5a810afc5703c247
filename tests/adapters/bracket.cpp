// SPDX-License-Identifier: BSD-3-Clause
#include "bracket.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Ax2.hxx>

namespace shapes {
namespace {

constexpr double length = 60, width = 40, height = 8;      // of the plate, millimetres
constexpr double boss = 12, top = 30, bore = 7, hole = 3;  // radii, and the height of the boss
constexpr double margin = 8, corner_radius = 6, foot = 4;  // of holes; of the plate's corners; of the boss's fillet

TopoDS_Shape column(double x, double y, double radius, double from, double to) {
  return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(x, y, from), gp_Dir(0, 0, 1)), radius, to - from).Shape();
}

/// The upright edges at the corners of the plate, and the circle on which the boss stands.
double fillet_radius(const BRepAdaptor_Curve& curve) {
  if (curve.GetType() == GeomAbs_Circle)
    return curve.Circle().Radius() == boss && std::abs(curve.Circle().Location().Z() - height) < 1e-9 ? foot : 0;
  const gp_Pnt p = curve.Value(curve.FirstParameter()), q = curve.Value(curve.LastParameter());
  const bool corner = std::min(p.X(), length - p.X()) < 1e-9 && std::min(p.Y(), width - p.Y()) < 1e-9;
  return corner && std::hypot(p.X() - q.X(), p.Y() - q.Y()) < 1e-9 ? corner_radius : 0;
}

TopoDS_Shape with_fillets(const TopoDS_Shape& solid) {
  BRepFilletAPI_MakeFillet fillets(solid);
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(solid, TopAbs_EDGE, edges);
  for (int i = 1; i <= edges.Extent(); ++i) {
    const TopoDS_Edge& edge = TopoDS::Edge(edges(i));
    if (const double radius = fillet_radius(BRepAdaptor_Curve(edge)); radius > 0) fillets.Add(radius, edge);
  }
  return fillets.Shape();
}

}  // namespace

TopoDS_Shape bracket() {
  const TopoDS_Shape plate = BRepPrimAPI_MakeBox(length, width, height).Shape();
  TopoDS_Shape solid = with_fillets(BRepAlgoAPI_Fuse(plate, column(length / 2, width / 2, boss, height, top)).Shape());
  solid = BRepAlgoAPI_Cut(solid, column(length / 2, width / 2, bore, -1, top + 1)).Shape();
  for (const double x : {margin, length - margin})
    for (const double y : {margin, width - margin})
      solid = BRepAlgoAPI_Cut(solid, column(x, y, hole, -1, height + 1)).Shape();
  return solid;
}

std::string name_in_bracket(const TopoDS_Face& face) {
  const BRepAdaptor_Surface surface(face);
  if (surface.GetType() == GeomAbs_Torus) return "fillet";
  if (surface.GetType() != GeomAbs_Cylinder) return "plate";
  const double radius = surface.Cylinder().Radius();
  return radius == bore ? "bore" : radius == hole ? "hole" : radius == boss ? "boss" : "corner";
}

}  // namespace shapes
