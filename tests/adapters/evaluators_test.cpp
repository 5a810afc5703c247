// SPDX-License-Identifier: BSD-3-Clause
// Adaptors of OpenCASCADE remember their last evaluation; Evaluators must not show it.
#include <evaluators.h>
#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Circle.hxx>
#include <Geom2d_Ellipse.hxx>
#include <Geom2d_Line.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <cmath>
#include <thread>

#include "shapes.h"

namespace {

using carreau_occ::Breaks;
using carreau_occ::Evaluators;

TopoDS_Face face_of(const char* shape) {
  return TopoDS::Face(TopExp_Explorer(shapes::make(shape), TopAbs_FACE).Current().Oriented(TopAbs_FORWARD));
}

struct Jet {
  gp_Pnt p;
  gp_Vec u, v, uu, vv, uv;
  bool operator==(const Jet& other) const {
    const auto same = [](const auto& a, const auto& b) { return a.X() == b.X() && a.Y() == b.Y() && a.Z() == b.Z(); };
    return same(p, other.p) && same(u, other.u) && same(v, other.v) && same(uu, other.uu) && same(vv, other.vv) &&
           same(uv, other.uv);
  }
};

Jet at(const Evaluators::Surface& surface, double u, double v) {
  Jet jet;
  surface.d2(u, v, jet.p, jet.u, jet.v, jet.uu, jet.vv, jet.uv);
  return jet;
}

TEST(Breaks, MoveOnlyNumbersARoundingErrorBelowOne) {
  const Breaks breaks({0, 1, 2, 3}, false, 0);
  EXPECT_EQ(breaks.settle(std::nextafter(2., 0.)), 2);
  EXPECT_EQ(breaks.settle(2), 2);
  EXPECT_EQ(breaks.settle(std::nextafter(2., 3.)), std::nextafter(2., 3.));
  EXPECT_EQ(breaks.settle(2 - 1e-14), 2 - 1e-14);
  EXPECT_EQ(breaks.settle(-1e-300), -1e-300);
  EXPECT_EQ(breaks.settle(7), 7);
  const Breaks turning({0, 1, 2, 3}, true, 3);
  EXPECT_EQ(turning.settle(5.5), 2.5);
  EXPECT_EQ(turning.settle(-0.5), 2.5);
  EXPECT_EQ(Breaks({0, 1}, true, 1).settle(5.5), 5.5);
}

// Parameters on, just before and just behind every knot, after a visit of the span before and of the span behind.
TEST(Evaluators, DoNotDependOnEarlierCalls) {
  const TopoDS_Face face = face_of("nurbs_torus");
  const Handle(Geom_BSplineSurface) spline = Handle(Geom_BSplineSurface)::DownCast(BRep_Tool::Surface(face));
  ASSERT_FALSE(spline.IsNull());
  ASSERT_GT(spline->NbUKnots(), 2);
  Evaluators evaluators;
  evaluators.resize(1);
  evaluators.set(0, face, {});
  const Evaluators::Surface surface = evaluators.surface(0);
  const double v = (spline->VKnot(1) + spline->VKnot(2)) / 2;
  for (int k = 2; k < spline->NbUKnots(); ++k)
    for (const double u :
         {std::nextafter(spline->UKnot(k), 0.), spline->UKnot(k), std::nextafter(spline->UKnot(k), 9.)}) {
      at(surface, (spline->UKnot(k - 1) + spline->UKnot(k)) / 2, v);
      const Jet from_below = at(surface, u, v);
      at(surface, (spline->UKnot(k) + spline->UKnot(k + 1)) / 2, v);
      EXPECT_TRUE(at(surface, u, v) == from_below) << k << ' ' << u;
    }
}

// Closed forms against adaptors, of faces where they are and moved.
TEST(Evaluators, ClosedFormsMatchAdaptors) {
  const gp_Ax3 axes(gp_Pnt(1, -2, 3), gp_Dir(1, 2, 2), gp_Dir(2, 1, -2));
  gp_Trsf moved;
  moved.SetRotation(gp_Ax1(gp_Pnt(4, 1, 0), gp_Dir(0, 3, 4)), 0.7);
  for (const gp_Trsf& placing : {gp_Trsf(), moved}) {
    const std::vector<TopoDS_Shape> made{BRepBuilderAPI_MakeFace(gp_Pln(axes), -1, 1, -1, 1).Shape(),
                                         BRepBuilderAPI_MakeFace(gp_Cylinder(axes, 2.5), 0, 3, -1, 1).Shape(),
                                         BRepBuilderAPI_MakeFace(gp_Cone(axes, 0.3, 2.5), 0, 3, -1, 1).Shape(),
                                         BRepBuilderAPI_MakeFace(gp_Sphere(axes, 2.5), 0, 3, -1, 1).Shape(),
                                         BRepBuilderAPI_MakeFace(gp_Torus(axes, 5, 2.5), 0, 3, -1, 1).Shape()};
    for (const TopoDS_Shape& shape : made) {
      const TopoDS_Face face = TopoDS::Face(shape.Moved(TopLoc_Location(placing)).Oriented(TopAbs_FORWARD));
      Evaluators evaluators;
      evaluators.resize(1);
      evaluators.set(0, face, {});
      ASSERT_TRUE(evaluators.is_closed_form(0));
      const BRepAdaptor_Surface adaptor(face, Standard_False);
      for (double u = 0; u < 3; u += 0.37)
        for (double v = -1; v < 1; v += 0.31) {
          const Jet found = at(evaluators.surface(0), u, v);
          Jet wanted;
          adaptor.D2(u, v, wanted.p, wanted.u, wanted.v, wanted.uu, wanted.vv, wanted.uv);
          EXPECT_LT(found.p.Distance(wanted.p), 1e-14 * 10);
          for (const gp_Vec& difference : {found.u - wanted.u, found.v - wanted.v, found.uu - wanted.uu,
                                           found.vv - wanted.vv, found.uv - wanted.uv})
            EXPECT_LT(difference.Magnitude(), 1e-14 * 10);
        }
    }
  }
}

TEST(Evaluators, ClosedFormsOfCurvesMatchAdaptors) {
  const gp_Ax22d axes(gp_Pnt2d(1, -2), gp_Dir2d(3, 4), Standard_False);
  const std::vector<Handle(Geom2d_Curve)> curves{
      new Geom2d_Line(gp_Pnt2d(1, 2), gp_Dir2d(3, -4)), new Geom2d_Circle(axes, 2.5), new Geom2d_Ellipse(axes, 2.5, 1),
      new Geom2d_TrimmedCurve(new Geom2d_Circle(axes, 2.5), 2, 1, Standard_False)};
  Evaluators evaluators;
  evaluators.resize(1);
  evaluators.set(0, TopoDS::Face(BRepBuilderAPI_MakeFace(gp_Pln(), -9, 9, -9, 9).Shape().Oriented(TopAbs_FORWARD)),
                 curves);
  for (std::size_t c = 0; c < curves.size(); ++c) {
    ASSERT_TRUE(evaluators.is_closed_form(0, c));
    const Geom2dAdaptor_Curve adaptor(curves[c]);
    for (double t = -1; t < 2; t += 0.17) {
      gp_Pnt2d p, q;
      gp_Vec2d p1, q1, p2, q2;
      evaluators.curve(0, c).d2(t, p, p1, p2);
      adaptor.D2(t, q, q1, q2);
      EXPECT_LT(p.Distance(q), 1e-14 * 5);
      EXPECT_LT((p1 - q1).Magnitude(), 1e-14 * 5);
      EXPECT_LT((p2 - q2).Magnitude(), 1e-14 * 5);
    }
  }
}

// A point and its neighbours have one number as long as no knot is between them.
TEST(Evaluators, PointsOfOnePolynomialHaveOneNumber) {
  const TopoDS_Face face = face_of("nurbs_torus");
  const Handle(Geom_BSplineSurface) spline = Handle(Geom_BSplineSurface)::DownCast(BRep_Tool::Surface(face));
  ASSERT_GT(spline->NbUKnots(), 2);
  Evaluators evaluators;
  evaluators.resize(1);
  evaluators.set(0, face, {});
  const Evaluators::Surface surface = evaluators.surface(0);
  ASSERT_TRUE(surface.has_patches());
  const double v = (spline->VKnot(1) + spline->VKnot(2)) / 2;
  for (int k = 1; k < spline->NbUKnots(); ++k) {
    const double low = spline->UKnot(k), high = spline->UKnot(k + 1), middle = (low + high) / 2;
    EXPECT_EQ(surface.patch_of(low + 0.1 * (high - low), v), surface.patch_of(middle, v));
    EXPECT_NE(surface.patch_of(low - 0.1 * (high - low), v), surface.patch_of(middle, v));
  }
}

TEST(Evaluators, GiveThreadsAdaptorsOfTheirOwn) {
  const TopoDS_Face face = face_of("nurbs_torus");
  Evaluators evaluators;
  evaluators.resize(1);
  evaluators.set(0, face, {});
  double a = 0, b = 0, c = 0, d = 0;
  BRep_Tool::Surface(face)->Bounds(a, b, c, d);
  const auto sample = [&] {
    std::vector<Jet> jets;
    for (int i = 0; i < 4000; ++i)
      jets.push_back(
          at(evaluators.surface(0), a + (b - a) * std::fmod(i * 0.618, 1), c + (d - c) * std::fmod(i * 0.382, 1)));
    return jets;
  };
  const std::vector<Jet> alone = sample();
  std::vector<std::vector<Jet>> together(4);
  std::vector<std::thread> threads;
  for (auto& jets : together) threads.emplace_back([&] { jets = sample(); });
  for (std::thread& thread : threads) thread.join();
  for (const auto& jets : together) EXPECT_TRUE(jets == alone);
}

}  // namespace
