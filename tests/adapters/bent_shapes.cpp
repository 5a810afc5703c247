// SPDX-License-Identifier: BSD-3-Clause
#include "bent_shapes.h"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRep_Builder.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <Geom2d_Line.hxx>
#include <GeomConvert_CompCurveToBSplineCurve.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Wire.hxx>
#include <cmath>
#include <gp_Ax1.hxx>
#include <gp_Ax2.hxx>
#include <gp_Trsf.hxx>
#include <numbers>

#include "shapes.h"

namespace shapes {
namespace {

constexpr double pi = std::numbers::pi;

/// A curve of degree 1 through the points; knots at 0, 1, 2, ...
Handle(Geom_BSplineCurve) polyline(const std::vector<gp_Pnt>& points) {
  const int n = static_cast<int>(points.size());
  TColgp_Array1OfPnt poles(1, n);
  TColStd_Array1OfReal knots(1, n);
  TColStd_Array1OfInteger times(1, n);
  for (int i = 1; i <= n; ++i) {
    poles(i) = points[static_cast<std::size_t>(i - 1)], knots(i) = i - 1;
    times(i) = i == 1 || i == n ? 2 : 1;
  }
  return new Geom_BSplineCurve(poles, knots, times, 1);
}

/// Two arcs of radius 2 that meet at the top of an arch one wide to either side, at 60 degrees with the horizontal.
Handle(Geom_BSplineCurve) gothic_arch() {
  const double root = std::sqrt(3.0);
  const gp_Pnt left(-1, 0, 0), right(1, 0, 0), top(0, 0, root);
  const Handle(Geom_TrimmedCurve) rising = GC_MakeArcOfCircle(left, gp_Pnt(1 - root, 0, 1), top).Value();
  const Handle(Geom_TrimmedCurve) falling = GC_MakeArcOfCircle(top, gp_Pnt(root - 1, 0, 1), right).Value();
  GeomConvert_CompCurveToBSplineCurve whole(rising);
  whole.Add(falling, 1e-9, Standard_True);
  return whole.BSplineCurve();
}

TopoDS_Face bounded_by(const Handle(Geom_Curve) & curve) {
  return BRepBuilderAPI_MakeFace(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(curve).Edge()).Wire(), Standard_True)
      .Face();
}

/// One edge around a square of side 2 in the plane z = 0, from a corner.
Handle(Geom_BSplineCurve) square() { return polyline({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}}); }

TopoDS_Shape cubic_roof() {
  const Handle(Geom_BSplineSurface) surface = roof();
  surface->IncreaseDegree(3, 2);
  return BRepBuilderAPI_MakeFace(surface, 1e-7).Face();
}

TopoDS_Shape vault() {
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeEdge(gothic_arch()).Edge(), gp_Vec(0, 3, 0)).Shape();
}

/// z = 2 - |x| - |y| over a square of side 2: bends cross.
TopoDS_Shape pyramid() {
  TColgp_Array2OfPnt poles(1, 3, 1, 3);
  for (int i = 1; i <= 3; ++i)
    for (int j = 1; j <= 3; ++j) poles(i, j) = gp_Pnt(i - 2, j - 2, 2 - std::abs(i - 2) - std::abs(j - 2));
  TColStd_Array1OfReal knots(1, 3);
  TColStd_Array1OfInteger times(1, 3);
  knots(1) = 0, knots(2) = 0.3, knots(3) = 1;
  times(1) = times(3) = 2, times(2) = 1;
  const Handle(Geom_BSplineSurface) surface = new Geom_BSplineSurface(poles, knots, knots, times, times, 1, 1);
  return BRepBuilderAPI_MakeFace(surface, 1e-7).Face();
}

/// A solid of one periodic surface, whose seam lies inside a side.
TopoDS_Shape square_pipe() {
  TColgp_Array2OfPnt poles(1, 5, 1, 2);
  const double xy[5][2] = {{0, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
  for (int i = 1; i <= 5; ++i)
    for (int j = 1; j <= 2; ++j) poles(i, j) = gp_Pnt(xy[i - 1][0], xy[i - 1][1], 3 * (j - 1));
  TColStd_Array1OfReal u(1, 6), v(1, 2);
  TColStd_Array1OfInteger mu(1, 6), mv(1, 2);
  for (int i = 1; i <= 6; ++i) u(i) = i == 6 ? 8 : i == 1 ? 0 : 2 * i - 3, mu(i) = 1;
  v(1) = 0, v(2) = 1, mv(1) = mv(2) = 2;
  const Handle(Geom_BSplineSurface) surface =
      new Geom_BSplineSurface(poles, u, v, mu, mv, 1, 1, Standard_True, Standard_False);
  return BRepBuilderAPI_MakeFace(surface, 1e-7).Face();
}

TopoDS_Shape prism() { return BRepPrimAPI_MakePrism(bounded_by(square()), gp_Vec(0, 0, 3)).Shape(); }

gp_Trsf mirror() {
  gp_Trsf mirrored;
  mirrored.SetMirror(gp_Ax2(gp_Pnt(5, 0, 0), gp_Dir(1, 0, 0)));
  return mirrored;
}

/// A hole of radius 1/2 along x and y = z = const through the middle of a bend, which it takes a piece of.
TopoDS_Shape drilled_prism() {
  const gp_Ax2 axis(gp_Pnt(3, 3, 1.5), gp_Dir(-1, -1, 0));
  return BRepAlgoAPI_Cut(prism(), BRepPrimAPI_MakeCylinder(axis, 0.5, 8).Shape()).Shape();
}

/// Around the axis x = 0, of a square of side 2 whose middle is at x = 3.
TopoDS_Shape square_ring() {
  const Handle(Geom_BSplineCurve) section = polyline({{2, 0, -1}, {4, 0, -1}, {4, 0, 1}, {2, 0, 1}, {2, 0, -1}});
  return BRepPrimAPI_MakeRevol(bounded_by(section), gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1))).Shape();
}

/// A face from pole to pole with a bend around its middle.
TopoDS_Shape two_cones() {
  const TopoDS_Edge side = BRepBuilderAPI_MakeEdge(polyline({{0, 0, -1}, {1, 0, 0}, {0, 0, 1}})).Edge();
  const TopoDS_Edge axis = BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0, 1), gp_Pnt(0, 0, -1)).Edge();
  const TopoDS_Face half = BRepBuilderAPI_MakeFace(BRepBuilderAPI_MakeWire(side, axis).Wire(), Standard_True).Face();
  return BRepPrimAPI_MakeRevol(half, gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1))).Shape();
}

}  // namespace

const std::vector<BentShape>& bent_shapes() {
  static const double slope = 1 / std::cos(pi / 6), root = std::sqrt(2.0);
  // The hole of radius r through opposite bends of the prism: at distance s from their plane it is 2 (root - |s|) long.
  static const double r = 0.5, hole = pi * r * r, wall = 4 * r * (pi * root - 2 * r),
                      bored = 2 * root * hole - 8.0 / 3 * r * r * r;
  static const std::vector<BentShape> all{
      {"roof", [] { return BRepBuilderAPI_MakeFace(shapes::roof(), 1e-7).Face(); }, 2 * slope, 0, 1, true},
      {"cubic_roof", cubic_roof, 2 * slope, 0, 1, true},
      {"vault", vault, 2 * (2 * pi / 3) * 3, 0, 1, false},
      {"pyramid", pyramid, 4 * std::sqrt(3.0), 0, 1, true},
      {"square_pipe", square_pipe, 24, 0, 1, true},
      {"prism", prism, 24 + 8, 12, 3, true},
      {"mirrored_prism", [] { return BRepBuilderAPI_Transform(prism(), mirror(), Standard_True).Shape(); }, 24 + 8, 12,
       3, true},
      {"drilled_prism", drilled_prism, 32 - 2 * root * hole + wall, 12 - bored, 4, false},
      {"square_ring", square_ring, 2 * pi * 3 * 8, 2 * pi * 3 * 4, 1, false},
      {"two_cones", two_cones, 2 * pi * root, 2 * pi / 3, 1, false},
  };
  return all;
}

TopoDS_Shape torn_roof() {
  const Handle(Geom_OffsetSurface) offset = new Geom_OffsetSurface(roof(), 1e-3, Standard_True);
  return BRepBuilderAPI_MakeFace(offset, 1e-7).Face();
}

TopoDS_Shape marked_roof() {
  const TopoDS_Face plain = BRepBuilderAPI_MakeFace(roof(), 1e-7).Face();
  const BRep_Builder builder;
  TopoDS_Face face = TopoDS::Face(plain.EmptyCopied());
  for (TopExp_Explorer e(plain, TopAbs_WIRE); e.More(); e.Next()) builder.Add(face, e.Current());
  TopoDS_Edge ridge = BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0.3, 0), gp_Pnt(0, 0.7, 0)).Edge();
  builder.UpdateEdge(ridge, new Geom2d_Line(gp_Pnt2d(0.25, 0.3), gp_Dir2d(0, 1)), face, 1e-7);
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  builder.Add(wire, ridge.Oriented(TopAbs_INTERNAL));
  builder.Add(face, wire.Oriented(TopAbs_INTERNAL));
  return face;
}

}  // namespace shapes
