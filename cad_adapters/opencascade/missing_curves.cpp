// SPDX-License-Identifier: BSD-3-Clause
#include "missing_curves.h"

#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Precision.hxx>
#include <ShapeFix_Wire.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Wire.hxx>

namespace carreau_occ {

namespace {

bool lacks_a_curve(const TopoDS_Wire& wire, const TopoDS_Face& face) {
  for (TopExp_Explorer e(wire, TopAbs_EDGE); e.More(); e.Next()) {
    double first = 0, last = 0;
    if (BRep_Tool::CurveOnSurface(TopoDS::Edge(e.Current()), face, first, last).IsNull()) return true;
  }
  return false;
}

}  // namespace

void add_missing_curves(const TopoDS_Face& face) {
  for (TopExp_Explorer e(face, TopAbs_WIRE); e.More(); e.Next()) {
    const TopoDS_Wire wire = TopoDS::Wire(e.Current());
    if (!lacks_a_curve(wire, face)) continue;
    ShapeFix_Wire fix(wire, face, Precision::Confusion());
    fix.FixReorder();
    fix.FixEdgeCurves();
  }
}

}  // namespace carreau_occ
