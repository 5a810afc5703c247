// SPDX-License-Identifier: BSD-3-Clause
#include "size/size_rules.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../curve/analytic_cad.h"
#include "four_patches.h"
#include "support/error.h"
#include "support/infinity.h"

namespace {

using namespace carreau;
using namespace carreau::testing_cad;
using std::numbers::pi;

const double middle[] = {0.4, 0.6};

TEST(SizeRules, MeansOfTheManualsFourPatches) {
  FourPatches s;
  SizeRules rules = s.rules(parameters(2, 0));
  const double expected[] = {0.45, 0.075, 0.125, 0.5};
  for (int c = 0; c < 4; ++c) EXPECT_DOUBLE_EQ(rules.on_curve(c, middle, 0.4), expected[c]);
  EXPECT_DOUBLE_EQ(rules.at_point(0), 0.2875);
  EXPECT_DOUBLE_EQ(rules.at_point(1), 0.45);
}

TEST(SizeRules, MinimumAndGeometricMeansOfTheFourPatches) {
  FourPatches s;
  SizeParameters p = parameters(2, 0);
  p.mean = SizeMean::minimum;
  SizeRules least = s.rules(p);
  const double smallest[] = {0.1, 0.05, 0.05, 0.2};
  for (int c = 0; c < 4; ++c) EXPECT_EQ(least.on_curve(c, middle, 0.4), smallest[c]);
  EXPECT_EQ(least.at_point(0), 0.05);
  p.mean = SizeMean::geometric;
  SizeRules geometric = s.rules(p);
  const double roots[] = {std::sqrt(0.08), std::sqrt(0.005), std::sqrt(0.01), std::sqrt(0.16)};
  for (int c = 0; c < 4; ++c) EXPECT_NEAR(geometric.on_curve(c, middle, 0.4), roots[c], 1e-15);
  EXPECT_NEAR(geometric.at_point(0), std::pow(0.05 * 0.1 * 0.2 * 0.8, 0.25), 1e-15);
  p.mean = SizeMean::arithmetic;
  EXPECT_DOUBLE_EQ(s.rules(p).on_curve(0, middle, 0.4), 0.45);
}

TEST(SizeRules, CurvesPrecedeSurfacesAndPointsPrecedeCurves) {
  FourPatches s;
  // Curve 1 answers through its second use only: face 4 sees it as its curve 1, from t = 0 outside to 1 at the centre.
  s.cad.hphyc = [](int face, int ic, double t) {
    return face == 4 && ic == 1 ? std::optional<double>(0.3 + 0.1 * t) : std::nullopt;
  };
  SizeRules rules = s.rules(parameters(2, 0));
  EXPECT_DOUBLE_EQ(rules.on_curve(0, middle, 0.4), 0.3 + 0.1 * 0.6);
  EXPECT_DOUBLE_EQ(rules.on_curve(1, middle, 0.4), 0.075);
  EXPECT_DOUBLE_EQ(rules.at_point(0), 0.4);  // the only curve that answers, at its end; no surface is called
  EXPECT_DOUBLE_EQ(rules.at_point(1), 0.3);
  s.cad.hphyp = [](int ref) { return ref == 6 ? std::optional<double>(0.01) : std::nullopt; };
  SizeRules with_point = s.rules(parameters(2, 0));
  EXPECT_DOUBLE_EQ(with_point.at_point(0), 0.01);
  EXPECT_DOUBLE_EQ(with_point.at_point(1), 0.3);
}

TEST(SizeRules, InterpolatesBetweenTheEndsWithoutAnswers) {
  FourPatches s;
  s.cad.hphys = [](int, Vec2) { return std::optional<double>(); };
  s.cad.hphyp = [](int ref) { return ref == 6 ? std::optional<double>(0.01) : std::optional<double>(0.5); };
  SizeParameters p = parameters(2, 0);
  EXPECT_DOUBLE_EQ(s.rules(p).on_curve(0, middle, 0.4), 0.01 + 0.4 * 0.49);
  p.law = SizeLaw::geometric;
  EXPECT_NEAR(s.rules(p).on_curve(0, middle, 0.4), 0.01 * std::pow(50, 0.4), 1e-15);
  p.law = SizeLaw::sinusoidal;
  EXPECT_NEAR(s.rules(p).on_curve(0, middle, 0.4), 0.255 - 0.245 * std::cos(0.4 * pi), 1e-15);
}

TEST(SizeRules, NoAnswerMeansTheDefault) {
  FourPatches s;
  s.cad.hphys = [](int, Vec2) { return std::optional<double>(); };
  SizeRules rules = s.rules(parameters(2, 0));
  EXPECT_EQ(rules.at_point(0), 0.094);
  EXPECT_DOUBLE_EQ(rules.on_curve(2, middle, 0.4), 0.094);
}

TEST(SizeRules, EveryAnswerIsClampedBeforeTheMean) {
  FourPatches s;
  s.cad.hphys = [](int face, Vec2) { return std::optional<double>(face == 8 ? 100 : face == 4 ? 0. : -3); };
  SizeRules rules = s.rules(parameters(2, 0));
  EXPECT_DOUBLE_EQ(rules.on_curve(0, middle, 0.4), (0.94 + 0.0094) / 2);
  EXPECT_DOUBLE_EQ(rules.on_curve(2, middle, 0.4), 0.0094);
  SizeParameters p = parameters(1, 0);
  p.hphydef = 7;
  EXPECT_EQ(s.rules(p).at_point(0), 0.94);
  EXPECT_EQ(s.rules(p).constant(), 0.94);
}

TEST(SizeRules, ConstantSizeNeedsNoCalls) {
  FourPatches s;
  SizeRules rules = s.rules(parameters(1, 0));
  EXPECT_EQ(rules.constant(), 0.094);
  EXPECT_EQ(rules.at_point(0), 0.094);
  EXPECT_EQ(rules.on_curve(0, middle, 0.4), 0.094);
  EXPECT_EQ(s.cad.calls.sizes, 0);
  EXPECT_EQ(s.cad.calls.surface(), 0);
  EXPECT_EQ(rules.surface_wants(), 0U);
  EXPECT_FALSE(s.rules(parameters(2, 0)).constant());
  EXPECT_FALSE(s.rules(parameters(1, 1)).constant());
}

TEST(SizeRules, PointsAreEvaluatedOnce) {
  FourPatches s;
  SizeRules rules = s.rules(parameters(2, 0));
  rules.at_point(0);
  const auto before = s.cad.calls.sizes;
  rules.at_point(0);
  rules.physical_at_point(0);
  EXPECT_EQ(s.cad.calls.sizes, before);
}

TEST(SizeRules, NamesTheRoutineOfAnAnswerThatIsNoNumber) {
  for (const double bad : {std::nan(""), infinity, -infinity}) {
    FourPatches s;
    s.cad.hphys = [&](int face, Vec2) { return std::optional<double>(face == 4 ? bad : 0.1); };
    SizeRules rules = s.rules(parameters(2, 0));
    try {
      rules.on_curve(0, middle, 0.4);
      FAIL();
    } catch (const CallbackError& error) {
      EXPECT_EQ(error.where().face, 4);
      EXPECT_TRUE(error.where().uv.has_value());
      EXPECT_NE(std::string(error.what()).find("cad_hphys"), std::string::npos);
    }
    s.cad.hphyc = [&](int, int, double) { return std::optional<double>(bad); };
    try {
      rules.on_curve(1, middle, 0.4);
      FAIL();
    } catch (const CallbackError& error) {
      EXPECT_EQ(error.where().curve, 2);
      EXPECT_EQ(error.where().t, 0.4);
      EXPECT_NE(std::string(error.what()).find("cad_hphyc"), std::string::npos);
    }
    s.cad.hphyp = [&](int) { return std::optional<double>(bad); };
    try {
      rules.at_point(0);
      FAIL();
    } catch (const CallbackError& error) {
      EXPECT_EQ(error.where().point, 6);
      EXPECT_NE(std::string(error.what()).find("cad_hphyp"), std::string::npos);
    }
  }
}

TEST(SizeRules, SurfacesFallBackToTheInterfaces) {
  FourPatches s;
  s.cad.hphys = [](int, Vec2 p) { return p.x() > 0 ? std::optional<double>(0.3) : std::nullopt; };
  SizeRules rules = s.rules(parameters(2, 0));
  const Vec2 uv[] = {{0.5, 0.5}, {-0.5, 0.5}, {-2, 0}};
  const SurfaceJet jets[3] = {};
  double h[3] = {};
  rules.on_surface(
      0, uv, jets, [](Vec2 p) { return p.x() < -1 ? 1e9 : 0.2; }, h);
  EXPECT_EQ(h[0], 0.3);
  EXPECT_EQ(h[1], 0.2);
  EXPECT_EQ(h[2], 0.94);
}

TEST(SizeRules, GeometricSizesOfASphereAndOfItsCircles) {
  // Curves of the four patches on a sphere of radius 2: two great circles through the origin of (u, v).
  FourPatches s(sphere(2));
  SizeRules rules = s.rules(parameters(0, 1));
  const double expected = 2 * std::sin(8 * pi / 180) * 2;
  EXPECT_EQ(rules.surface_wants(), static_cast<unsigned>(want_first | want_second));
  EXPECT_NEAR(rules.on_curve(0, middle, 0.4), expected, 1e-14);
  EXPECT_NEAR(rules.at_point(0), expected, 1e-14);
  EXPECT_EQ(rules.physical_at_point(0), infinity);
}

TEST(SizeRules, CurvesOwnRadiusCounts) {
  // A circle of radius 0.25 in a plane; the plane itself is straight.
  FourPatches s;
  for (const auto& [face, t] : {std::pair{8, 1.}, std::pair{4, -1.}}) {
    s.cad.curves[{face, 1}] = {{0, 1}, [](double w) {
                                 const double c = std::cos(w) / 4, z = std::sin(w) / 4;
                                 return CurveJet{{c, z}, {-z, c}, {-c, -z}};
                               }};
  }
  SizeRules rules = s.rules(parameters(0, 1));
  EXPECT_NEAR(rules.on_curve(0, middle, 0.4), 0.5 * std::sin(8 * pi / 180), 1e-14);
  EXPECT_EQ(rules.on_curve(1, middle, 0.4), 0.94);                      // straight: the largest
  EXPECT_NEAR(rules.at_point(0), 0.5 * std::sin(8 * pi / 180), 1e-14);  // smallest over the curves that end there
}

TEST(SizeRules, TheSmallerOfBothSizesCounts) {
  FourPatches s(sphere(2));
  SizeRules rules = s.rules(parameters(2, 1));
  const double geometric = 4 * std::sin(8 * pi / 180);  // 0.5567
  EXPECT_NEAR(rules.on_curve(0, middle, 0.4), 0.45, 1e-14);
  EXPECT_NEAR(rules.on_curve(3, middle, 0.4), 0.5, 1e-14);
  const Vec2 uv[] = {{0.1, 0.2}};
  const SurfaceJet jet[] = {s.cad.surfaces[8].jet(uv[0])};
  double h[1];
  rules.on_surface(3, uv, jet, {}, h);
  EXPECT_NEAR(h[0], geometric, 1e-14);
  rules.on_surface(0, uv, jet, {}, h);
  EXPECT_EQ(h[0], 0.05);
}

TEST(SizeRules, RadiiOfTheHostReplaceCurvatures) {
  FourPatches s(sphere(2));
  s.cad.rads = [](int face, Vec2) { return face == 8 ? std::optional<double>(-0.5) : std::optional<double>(3e38); };
  s.cad.radc = [](int, int, double) { return std::optional<double>(0.75); };
  SizeRules rules = s.rules(parameters(0, 2));
  const double lambda = 2 * std::sin(8 * pi / 180);
  EXPECT_EQ(rules.surface_wants(), 0U);
  EXPECT_NEAR(rules.on_curve(0, middle, 0.4), lambda * 0.5, 1e-15);   // faces 8 and 4
  EXPECT_NEAR(rules.on_curve(1, middle, 0.4), lambda * 0.75, 1e-15);  // faces 4 and 1: the curve's own
  EXPECT_EQ(s.cad.calls.surface(), 0);
  s.cad.rads = [](int, Vec2) { return std::optional<double>(); };  // silent: computed
  const Vec2 uv[] = {{0.1, 0.2}};
  double h[1];
  rules.on_surface(0, uv, {}, {}, h);
  EXPECT_NEAR(h[0], lambda * 2, 1e-14);
  s.cad.rads = [](int, Vec2) { return std::optional<double>(std::nan("")); };
  EXPECT_THROW(rules.on_surface(0, uv, {}, {}, h), CallbackError);
}

/// A lune of the sphere: two meridians that end at the north pole, and the degenerate side between them.
TEST(SizeRules, PolesTakeTheRadiusBesideThem) {
  AnalyticCad cad;
  cad.surfaces[1] = sphere(2);
  cad.curves[{1, 1}] = segment({0, 0}, {0, pi / 2});
  cad.curves[{1, 2}] = segment({0, pi / 2}, {1, pi / 2});
  Model model;
  model.faces.push_back({1, 1, {{CurveType::boundary, 1, 1, 2, 0}, {CurveType::boundary, 2, 2, 2, 0}}, {}});
  Topology topology;
  topology.curves = {{1, {{0, 0, false}}, 0, 1, false}, {2, {{0, 1, false}}, 1, 1, true}};
  topology.points = {{1, {2, 0, 0}, {0}}, {2, {0, 0, 2}, {0, 1}}};
  SizeRules rules(model, topology, cad, parameters(0, 1));
  const double expected = 4 * std::sin(8 * pi / 180);
  EXPECT_NEAR(rules.at_point(1), expected, 1e-9);
  // Inside a face, the pole takes the answer of the nearest sound point of the batch.
  const Vec2 uv[] = {{0.5, pi / 2}, {0.5, 1.2}};
  const SurfaceJet jets[] = {cad.surfaces[1].jet(uv[0]), cad.surfaces[1].jet(uv[1])};
  double h[2];
  rules.on_surface(0, uv, jets, {}, h);
  EXPECT_NEAR(h[0], expected, 1e-12);
  EXPECT_NEAR(h[1], expected, 1e-12);
}

TEST(SizeRules, ASeamCountsOncePerUseAndItsEndOncePerCorner) {
  // A cylinder whose lower circle touches a plane: at the lower end of the seam the cylinder has two corners, the plane
  // one.
  AnalyticCad cad;
  cad.surfaces[1] = cylinder(1);
  cad.surfaces[2] = flat();
  cad.curves[{1, 1}] = segment({0, 0}, {0, 1});
  cad.curves[{1, 2}] = segment({2 * pi, 0}, {2 * pi, 1});
  cad.curves[{1, 3}] = segment({0, 0}, {2 * pi, 0});
  cad.curves[{2, 1}] = plane_curve({0, 2 * pi}, [](double t) { return Vec2{std::cos(t), std::sin(t)}; });
  cad.hphys = [](int face, Vec2) { return std::optional<double>(face == 1 ? 0.1 : 0.4); };
  Model model;
  model.faces.resize(2);
  model.faces[0].ref = 1;
  model.faces[0].curves.resize(3);
  model.faces[1].ref = 2;
  model.faces[1].curves.resize(1);
  Topology topology;
  topology.curves = {{1, {{0, 0, false}, {0, 1, false}}, 0, 1, false},
                     {2, {{0, 2, false}, {1, 0, false}}, 0, 0, false}};
  topology.points = {{1, {1, 0, 0}, {0, 1}}, {2, {1, 0, 1}, {0}}};
  SizeRules rules(model, topology, cad, parameters(2, 0));
  EXPECT_DOUBLE_EQ(rules.on_curve(1, middle, 0.4), 0.25);
  EXPECT_DOUBLE_EQ(rules.on_curve(0, middle, 0.4), 0.1);
  EXPECT_DOUBLE_EQ(rules.at_point(0), (0.1 + 0.1 + 0.4) / 3);
}

TEST(SizeRules, RejectsParametersThatContradictThemselves) {
  FourPatches s;
  EXPECT_THROW(s.rules(parameters(0, 0)), InvalidArgument);
  const auto with = [](auto change) {
    SizeParameters p = parameters(1, 1);
    change(p);
    return p;
  };
  EXPECT_THROW(s.rules(with([](auto& p) { p.hphymin = 0; })), InvalidArgument);
  EXPECT_THROW(s.rules(with([](auto& p) { p.hphymax = 1e-3; })), InvalidArgument);
  EXPECT_THROW(s.rules(with([](auto& p) { p.hgeomax = std::nan(""); })), InvalidArgument);
  EXPECT_THROW(s.rules(with([](auto& p) { p.hphydef = std::nan(""); })), InvalidArgument);
  EXPECT_THROW(s.rules(with([](auto& p) { p.angle_mesh = 0; })), InvalidArgument);
  EXPECT_NO_THROW(s.rules(parameters(1, 1)));
}

TEST(MeanSize, IsBoundedAndOrdered) {
  const double values[] = {0.05, 0.1, 0.2, 0.8};
  const double least = mean_size(SizeMean::minimum, values), geometric = mean_size(SizeMean::geometric, values),
               arithmetic = mean_size(SizeMean::arithmetic, values);
  EXPECT_EQ(least, 0.05);
  EXPECT_LT(least, geometric);
  EXPECT_LT(geometric, arithmetic);
  const std::vector<double> many(1000, 1e-9);  // a product would underflow
  EXPECT_NEAR(mean_size(SizeMean::geometric, many), 1e-9, 1e-22);
  EXPECT_THROW(mean_size(SizeMean::arithmetic, {}), InvalidArgument);
}

TEST(SmallestRadius, AgreesWithClosedForms) {
  EXPECT_NEAR(*smallest_radius(sphere(3).jet({0.4, 1.1})), 3, 1e-13);
  EXPECT_NEAR(*smallest_radius(cylinder(0.5).jet({1, 7})), 0.5, 1e-14);
  EXPECT_EQ(*smallest_radius(flat().jet({1, 7})), infinity);
  // Paraboloid: curvatures 1 / (1 + r^2)^(3/2) along the radius, 1 / (1 + r^2)^(1/2) across.
  for (const Vec2& p : {Vec2{0, 0}, Vec2{1, 0.5}, Vec2{-2, 2.5}}) {
    EXPECT_NEAR(*smallest_radius(paraboloid().jet(p)), std::sqrt(1 + dot(p, p)), 1e-13);
  }
}

TEST(SmallestRadius, DoesNotDependOnTheParametrisation) {
  // The same surface in sheared and stretched parameters: su' = a su, sv' = b su + c sv.
  const SurfaceJet j = paraboloid().jet({1.3, -0.4});
  const double radius = *smallest_radius(j);
  for (const double a : {1., 1e-5, 1e6}) {
    for (const double b : {0., 3.}) {
      const double c = 0.2;
      SurfaceJet k;
      k.su = a * j.su;
      k.sv = b * j.su + c * j.sv;
      k.suu = (a * a) * j.suu;
      k.suv = (a * b) * j.suu + (a * c) * j.suv;
      k.svv = (b * b) * j.suu + (2 * b * c) * j.suv + (c * c) * j.svv;
      EXPECT_NEAR(*smallest_radius(k), radius, 1e-9 * radius);
    }
  }
}

TEST(SmallestRadius, IsEmptyWhereTheParametrisationCollapses) {
  EXPECT_FALSE(smallest_radius(sphere(1).jet({0.3, pi / 2})));
  EXPECT_TRUE(smallest_radius(sphere(1).jet({0.3, pi / 2 - 1e-3})));
  SurfaceJet parallel;
  parallel.su = {1, 2, 3};
  parallel.sv = {2, 4, 6};
  EXPECT_FALSE(smallest_radius(parallel));
  EXPECT_FALSE(smallest_radius(SurfaceJet{}));
}

TEST(CurveRadius, AgreesWithClosedForms) {
  // Parallel of latitude v on a sphere: R cos v; a meridian: R; a helix on a cylinder: (R^2 + c^2) / R.
  EXPECT_NEAR(curve_radius(sphere(2).jet({0.3, 1}), {{0.3, 1}, {5, 0}, {}}), 2 * std::cos(1.), 1e-13);
  EXPECT_NEAR(curve_radius(sphere(2).jet({0.3, 1}), {{0.3, 1}, {0, 0.1}, {0, 7}}), 2, 1e-12);
  EXPECT_NEAR(curve_radius(cylinder(2).jet({0.3, 1}), {{0.3, 1}, {1, 0.5}, {}}), (4 + 0.25) / 2, 1e-13);
  EXPECT_EQ(curve_radius(cylinder(2).jet({0.3, 1}), {{0.3, 1}, {0, 1}, {0, 3}}), infinity);
  EXPECT_EQ(curve_radius(cylinder(2).jet({0.3, 1}), {{0.3, 1}, {0, 0}, {}}), infinity);
}

}  // namespace
