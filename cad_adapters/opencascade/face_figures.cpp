// SPDX-License-Identifier: BSD-3-Clause
#include "face_figures.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepBndLib.hxx>
#include <BRepGProp.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GCPnts_AbscissaPoint.hxx>
#include <GProp_GProps.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <cmath>

#include "faults.h"

namespace carreau_occ {
namespace {

void measure(const TopoDS_Face& face, FaceFigures& figures) {
  figures.kind = kind_name(BRepAdaptor_Surface(face, Standard_False).GetType());
  Bnd_Box box;
  BRepBndLib::AddOptimal(face, box, Standard_False, Standard_False);
  if (!box.IsVoid())
    box.Get(figures.low[0], figures.low[1], figures.low[2], figures.high[0], figures.high[1], figures.high[2]);
  GProp_GProps properties;
  BRepGProp::SurfaceProperties(face, properties);
  figures.area = std::abs(properties.Mass());
  for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(e.Current());
    // A seam is within the face: it bounds nothing.
    if (!BRep_Tool::Degenerated(edge) && !BRep_Tool::IsClosed(edge, face))
      figures.perimeter += GCPnts_AbscissaPoint::Length(BRepAdaptor_Curve(edge));
  }
}

}  // namespace

const char* kind_name(GeomAbs_SurfaceType type) {
  switch (type) {
    case GeomAbs_Plane:
      return "plane";
    case GeomAbs_Cylinder:
      return "cylinder";
    case GeomAbs_Cone:
      return "cone";
    case GeomAbs_Sphere:
      return "sphere";
    case GeomAbs_Torus:
      return "torus";
    case GeomAbs_BezierSurface:
      return "Bezier surface";
    case GeomAbs_BSplineSurface:
      return "B-spline surface";
    case GeomAbs_SurfaceOfRevolution:
      return "surface of revolution";
    case GeomAbs_SurfaceOfExtrusion:
      return "surface of extrusion";
    case GeomAbs_OffsetSurface:
      return "offset surface";
    default:
      return "other surface";
  }
}

std::vector<FaceFigures> list_faces(const ShapeFile& file) {
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(file.shape, TopAbs_FACE, faces);
  std::vector<FaceFigures> list;
  for (int number = 1; number <= faces.Extent(); ++number) {
    FaceFigures figures;
    figures.number = number;
    try {
      guarded([&] { measure(TopoDS::Face(faces(number)), figures); });
    } catch (const Standard_Failure&) {  // the figures so far are kept
      if (figures.kind.empty()) figures.kind = "broken";
    }
    list.push_back(std::move(figures));
  }
  return list;
}

}  // namespace carreau_occ
