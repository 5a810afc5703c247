// SPDX-License-Identifier: BSD-3-Clause
#include "odd_cylinder.h"

#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Cylinder.hxx>
#include <utility>
#include <vector>

namespace adapters {
namespace {

class OddCylinder : public Geom_CylindricalSurface {
 public:
  OddCylinder(const gp_Cylinder& cylinder, std::function<void(double, double)> before)
      : Geom_CylindricalSurface(cylinder), before_(std::move(before)) {}
  void D0(double u, double v, gp_Pnt& p) const override { before_(u, v), Geom_CylindricalSurface::D0(u, v, p); }
  void D1(double u, double v, gp_Pnt& p, gp_Vec& su, gp_Vec& sv) const override {
    before_(u, v), Geom_CylindricalSurface::D1(u, v, p, su, sv);
  }
  void D2(double u, double v, gp_Pnt& p, gp_Vec& su, gp_Vec& sv, gp_Vec& suu, gp_Vec& svv, gp_Vec& suv) const override {
    before_(u, v), Geom_CylindricalSurface::D2(u, v, p, su, sv, suu, svv, suv);
  }
  // Another type than Geom_CylindricalSurface: adaptors evaluate that one themselves.
  DEFINE_STANDARD_RTTI_INLINE(OddCylinder, Geom_CylindricalSurface)

 private:
  std::function<void(double, double)> before_;
};

}  // namespace

TopoDS_Shape odd_cylinder(std::function<void(double, double)> before) {
  const TopoDS_Shape solid = BRepPrimAPI_MakeCylinder(1, 2).Shape();
  const TopoDS_Face round = TopoDS::Face(TopExp_Explorer(solid, TopAbs_FACE).Current());
  const auto cylinder = Handle(Geom_CylindricalSurface)::DownCast(BRep_Tool::Surface(round));
  // Images of edges belong to a surface: the new surface gets the images of the old surface.
  struct Image {
    TopoDS_Edge edge;
    Handle(Geom2d_Curve) forward, reversed;
  };
  std::vector<Image> images;
  double a = 0, b = 0;
  for (TopExp_Explorer e(round.Oriented(TopAbs_FORWARD), TopAbs_EDGE); e.More(); e.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(e.Current().Oriented(TopAbs_FORWARD));
    images.push_back({edge, BRep_Tool::CurveOnSurface(edge, round, a, b),
                      BRep_Tool::CurveOnSurface(TopoDS::Edge(edge.Reversed()), round, a, b)});
  }
  const BRep_Builder builder;
  builder.UpdateFace(round, new OddCylinder(cylinder->Cylinder(), std::move(before)), {}, 1e-7);
  for (const Image& image : images)
    if (image.forward == image.reversed)
      builder.UpdateEdge(image.edge, image.forward, round, 1e-7);
    else
      builder.UpdateEdge(image.edge, image.forward, image.reversed, round, 1e-7);
  return solid;
}

}  // namespace adapters
