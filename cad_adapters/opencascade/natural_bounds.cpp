// SPDX-License-Identifier: BSD-3-Clause
#include "natural_bounds.h"

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom_Surface.hxx>
#include <Precision.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Iterator.hxx>

namespace carreau_occ {

namespace {

bool is_bounded(const Geom_Surface& surface) {
  double u1 = 0, u2 = 0, v1 = 0, v2 = 0;
  surface.Bounds(u1, u2, v1, v2);
  return !Precision::IsInfinite(u1) && !Precision::IsInfinite(u2) && !Precision::IsInfinite(v1) &&
         !Precision::IsInfinite(v2);
}

}  // namespace

void add_natural_bounds(const TopoDS_Shape& shape) {
  for (TopExp_Explorer e(shape, TopAbs_FACE); e.More(); e.Next()) {
    // Wires are turned for the face taken forward, and lie where it does before it is placed.
    TopoDS_Face face = TopoDS::Face(e.Current().Oriented(TopAbs_FORWARD).Located(TopLoc_Location()));
    if (TopoDS_Iterator(face).More()) continue;
    TopLoc_Location own;
    const Handle(Geom_Surface) surface = BRep_Tool::Surface(face, own);
    if (surface.IsNull() || !own.IsIdentity() || !is_bounded(*surface)) continue;
    BRepBuilderAPI_MakeFace whole(surface, Precision::Confusion());
    if (!whole.IsDone()) continue;
    const BRep_Builder builder;
    const bool is_free = face.Free() == Standard_True;
    face.Free(Standard_True);
    for (TopoDS_Iterator wire(whole.Face()); wire.More(); wire.Next()) builder.Add(face, wire.Value());
    face.Free(is_free);
  }
}

}  // namespace carreau_occ
