// SPDX-License-Identifier: BSD-3-Clause
// Adaptors of OpenCASCADE remember what they evaluated last; Evaluators must not show it.
#include <evaluators.h>
#include <gtest/gtest.h>

#include <BRep_Tool.hxx>
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

TEST(Breaks, MoveOnlyWhatIsARoundingErrorBelowOne) {
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

// Parameters on, just before and just behind every knot, after a visit of the span before and of the one behind.
TEST(Evaluators, DoNotRememberWhatWasAskedBefore) {
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
