// SPDX-License-Identifier: BSD-3-Clause
#include "face_check.h"

#include <BRepAdaptor_Surface.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <gp_Pnt.hxx>
#include <gp_Pnt2d.hxx>
#include <stdexcept>
#include <string>

namespace carreau_occ {
namespace {

constexpr int edge_samples = 4;  // intervals of an edge

bool is_near(const gp_Pnt& p) { return usable(p.X()) && usable(p.Y()) && usable(p.Z()); }

bool usable_poles(const Geom_BSplineSurface& surface) {
  for (int i = 1; i <= surface.NbUPoles(); ++i)
    for (int j = 1; j <= surface.NbVPoles(); ++j)
      if (!is_near(surface.Pole(i, j)) || !usable(surface.Weight(i, j))) return false;
  return true;
}

}  // namespace

void refuse_unusable(const TopoDS_Face& face, const std::vector<std::vector<EdgeImage>>& wires) {
  const auto require = [](bool good, const char* what) {
    if (!good) throw std::runtime_error(std::string(what) + " is not finite, or beyond 1e15");
  };
  for (TopExp_Explorer v(face, TopAbs_VERTEX); v.More(); v.Next()) {
    const TopoDS_Vertex vertex = TopoDS::Vertex(v.Current());
    require(is_near(BRep_Tool::Pnt(vertex)), "a vertex");
    require(usable(BRep_Tool::Tolerance(vertex)), "the tolerance of a vertex");
  }
  const auto spline = Handle(Geom_BSplineSurface)::DownCast(BRep_Tool::Surface(face));
  require(spline.IsNull() || usable_poles(*spline), "a pole of the surface");
  const BRepAdaptor_Surface surface(face, Standard_False);
  for (const std::vector<EdgeImage>& wire : wires)
    for (const EdgeImage& image : wire)
      for (int i = 0; i <= edge_samples && !image.curve.IsNull(); ++i) {
        const gp_Pnt2d uv = image.curve->Value(image.first + (image.last - image.first) * i / edge_samples);
        require(usable(uv.X()) && usable(uv.Y()) && is_near(surface.Value(uv.X(), uv.Y())), "the boundary");
      }
}

}  // namespace carreau_occ
