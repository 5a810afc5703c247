// SPDX-License-Identifier: BSD-3-Clause
#include "shapes.h"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <gp_Ax2.hxx>
#include <numbers>
#include <stdexcept>

namespace shapes {
namespace {

gp_Ax2 axis(double x, double y, double z, double dx, double dy, double dz) {
  return {gp_Pnt(x, y, z), gp_Dir(dx, dy, dz)};
}

TopoDS_Shape as_nurbs(const TopoDS_Shape& shape) { return BRepBuilderAPI_NurbsConvert(shape, Standard_True).Shape(); }

TopoDS_Shape box_with_hole() {
  return BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(3, 2, 1).Shape(),
                         BRepPrimAPI_MakeCylinder(axis(1.2, 1, -1, 0, 0, 1), 0.6, 3).Shape())
      .Shape();
}

// A bore a thousand times thinner than the plate is wide.
TopoDS_Shape thin_bore() {
  return BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(10, 10, 1).Shape(),
                         BRepPrimAPI_MakeCylinder(axis(4, 5, -1, 0, 0, 1), 0.005, 3).Shape())
      .Shape();
}

// A cube with one edge cut off by a plane: a face that is 1e-4 of the diagonal wide.
TopoDS_Shape sliver() {
  const double width = 1e-4 * std::sqrt(3.0) / std::sqrt(2.0);
  BRepBuilderAPI_MakePolygon polygon;
  for (const auto& [x, y] : {std::pair{0., 0.}, {1., 0.}, {1., 1 - width}, {1 - width, 1.}, {0., 1.}})
    polygon.Add(gp_Pnt(x, y, 0));
  polygon.Close();
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(polygon.Wire()).Face(), gp_Vec(0, 0, 1)).Shape();
}

// The seams of OpenCASCADE's cylinders lie on the side of x > 0.
TopoDS_Shape across_a_seam() {
  return BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(1, 4).Shape(),
                         BRepPrimAPI_MakeCylinder(axis(0, 0.1, 2, 1, 0, 0), 0.5, 3).Shape())
      .Shape();
}

TopoDS_Shape through_a_pole() {
  return BRepAlgoAPI_Cut(BRepPrimAPI_MakeSphere(1).Shape(),
                         BRepPrimAPI_MakeBox(gp_Pnt(0, 0, -2), gp_Pnt(2, 2, 2)).Shape())
      .Shape();
}

// A bore a hundred thousand times thinner than the plate is wide: its circles are shorter than the length that counts
// as a point.
TopoDS_Shape pinhole() {
  return BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(1000, 1000, 10).Shape(),
                         BRepPrimAPI_MakeCylinder(axis(300, 500, -1, 0, 0, 1), 0.004, 12).Shape())
      .Shape();
}

TopoDS_Shape two_cylinders() {
  return BRepAlgoAPI_Fuse(BRepPrimAPI_MakeCylinder(1, 4).Shape(),
                          BRepPrimAPI_MakeCylinder(axis(-3, 0, 2, 1, 0, 0), 0.8, 6).Shape())
      .Shape();
}

}  // namespace

const std::vector<NamedShape>& torture_set() {
  static const std::vector<NamedShape> all{
      {"sphere", [] { return BRepPrimAPI_MakeSphere(1).Shape(); }},
      {"torus", [] { return BRepPrimAPI_MakeTorus(3, 1).Shape(); }},
      {"cone", [] { return BRepPrimAPI_MakeCone(1, 0, 2).Shape(); }},
      {"cylinder", [] { return BRepPrimAPI_MakeCylinder(1, 2).Shape(); }},
      {"box_with_hole", box_with_hole},
      {"nurbs_sphere", [] { return as_nurbs(BRepPrimAPI_MakeSphere(1).Shape()); }},
      {"nurbs_torus", [] { return as_nurbs(BRepPrimAPI_MakeTorus(3, 1).Shape()); }},
      {"thin_bore", thin_bore, true},
      {"sliver", sliver, true},
      {"pinhole", pinhole, true},
      {"wire", [] { return BRepPrimAPI_MakeBox(1000, 0.01, 0.01).Shape(); }, true},
      {"waist", [] { return BRepPrimAPI_MakeTorus(1.0001, 1).Shape(); }},
      {"across_a_seam", across_a_seam},
      {"through_a_pole", through_a_pole},
      {"two_cylinders", two_cylinders},
  };
  return all;
}

TopoDS_Shape make(const std::string& name) {
  for (const NamedShape& shape : torture_set())
    if (shape.name == name) return shape.make();
  throw std::runtime_error("there is no shape '" + name + "'");
}

Handle(Geom_BSplineSurface) roof() {
  TColgp_Array2OfPnt poles(1, 3, 1, 2);
  const double slope = std::tan(std::numbers::pi / 6);
  for (int i = 1; i <= 3; ++i)
    for (int j = 1; j <= 2; ++j) poles(i, j) = gp_Pnt(i - 2, j - 1, -slope * std::abs(i - 2));
  TColStd_Array1OfReal u(1, 3), v(1, 2);
  TColStd_Array1OfInteger mu(1, 3), mv(1, 2);
  u(1) = 0, u(2) = 0.25, u(3) = 1, v(1) = 0, v(2) = 1;
  mu(1) = mu(3) = mv(1) = mv(2) = 2, mu(2) = 1;
  return new Geom_BSplineSurface(poles, u, v, mu, mv, 1, 1);
}

}  // namespace shapes
