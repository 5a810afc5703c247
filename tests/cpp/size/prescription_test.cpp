// SPDX-License-Identifier: BSD-3-Clause
// Sizes that differ by direction: geometric metrics, sources, and how they are combined.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/field_source.h"
#include "four_patches.h"
#include "size/thresholds.h"
#include "support/error.h"
#include "support/infinity.h"

namespace {

using namespace carreau;
using namespace carreau::testing_cad;
using carreau::testing::field_of_space;
using carreau::testing::FieldSource;
using std::numbers::pi;

const std::array<double, 2> middle{0.4, 0.6};

SizeParameters geometric(bool anisotropic) {
  SizeParameters p = parameters(0, 1);
  p.geo_anisotropic = anisotropic;
  return p;
}

Metric2 metric_at(SizeRules& rules, AnalyticCad& cad, int face, Vec2 uv) {
  const int ref[] = {1, 4, 5, 8};
  const SurfaceJet jet = cad.surfaces.at(ref[face]).jet(uv);
  Metric2 m;
  rules.on_surface(face, {&uv, 1}, {&jet, 1}, [](Vec2) { return 0.2; }, std::span<Metric2>(&m, 1));
  return m;
}

/// Size along a direction of the parameter plane.
double size_along(Metric2 m, const SurfaceJet& jet, Vec2 d) {
  return norm(d.x() * jet.su + d.y() * jet.sv) / length(m, d);
}

void expect_near(Metric2 m, Metric2 expected, double tolerance) {
  const double scale = std::abs(expected.a) + std::abs(expected.c);
  EXPECT_NEAR(m.a, expected.a, tolerance * scale);
  EXPECT_NEAR(m.b, expected.b, tolerance * scale);
  EXPECT_NEAR(m.c, expected.c, tolerance * scale);
}

template <typename Body>
std::string sentence_of(Body&& body) {
  try {
    body();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

const Metric3 slanted{30, 4, -2, 50, 3, 20};

// ---- geometry ----

TEST(GeometricMetrics, OnACylinderTheSecondRadiusIsInfinite) {
  FourPatches s(cylinder(0.7));
  const SizeParameters p = geometric(true);
  SizeRules rules = s.rules(p);
  EXPECT_TRUE(rules.uses_metrics());
  const double h1 = 2 * std::sin(p.angle_mesh * pi / 180) * 0.7;
  const Vec2 uv{0.3, 0.2};
  const SurfaceJet jet = s.cad.surfaces.at(1).jet(uv);
  const Metric2 m = metric_at(rules, s.cad, 0, uv);
  EXPECT_NEAR(size_along(m, jet, {1, 0}), h1, 1e-12);
  EXPECT_NEAR(size_along(m, jet, {0, 1}), p.hgeomax, 1e-12);
  EXPECT_NEAR(m.b, 0, 1e-12);
  // Curve 0 goes along v, a straight line; curve 1 along u, a circle.
  EXPECT_NEAR(rules.on_curve(0, middle, 0.4), p.hgeomax, 1e-12);
  EXPECT_NEAR(rules.on_curve(1, middle, 0.4), h1, 1e-12);
  // Both meet at the point 0.
  EXPECT_NEAR(rules.at_point(0), h1, 1e-12);
  SizeParameters bounded = p;
  bounded.anisotropy_max = 3;
  SizeRules few = s.rules(bounded);
  EXPECT_NEAR(few.on_curve(0, middle, 0.4), 3 * h1, 1e-12);
  EXPECT_NEAR(few.on_curve(1, middle, 0.4), h1, 1e-12);
}

TEST(GeometricMetrics, IsotropicOnesAreTheSmallestPrincipalSize) {
  for (const auto& surface : {cylinder(0.7), paraboloid(), sphere(0.5)}) {
    for (const auto rule : {GeometricCriterion::angle, GeometricCriterion::chord, GeometricCriterion::both}) {
      FourPatches s(surface);
      SizeParameters p = geometric(false);
      p.geo_rule = rule;
      p.eps_chord = 0.003;
      SizeRules scalar = s.rules(p);
      p.geo_anisotropic = true;
      SizeRules tensor = s.rules(p);
      const Vec2 uv{0.4, 0.3};
      const SurfaceJet jet = s.cad.surfaces.at(1).jet(uv);
      double h = 0;
      scalar.on_surface(0, {&uv, 1}, {&jet, 1}, {}, std::span<double>(&h, 1));
      const LengthRatios ratios = length_ratios(metric_at(tensor, s.cad, 0, uv), induced_metric(jet.su, jet.sv, h));
      EXPECT_NEAR(ratios.largest, 1, 1e-12);
    }
  }
}

TEST(GeometricMetrics, ASphereIsAnUmbilicEverywhere) {
  FourPatches s(sphere(0.5));
  SizeRules rules = s.rules(geometric(true));
  const double h = 2 * std::sin(8 * pi / 180) * 0.5;
  const Vec2 uv{0.4, 0.9};
  const SurfaceJet jet = s.cad.surfaces.at(1).jet(uv);
  expect_near(metric_at(rules, s.cad, 0, uv), induced_metric(jet.su, jet.sv, h), 1e-12);
}

TEST(GeometricMetrics, APoleTakesTheSizeOfTheNearestSoundPoint) {
  FourPatches s(sphere(0.5));
  SizeRules rules = s.rules(geometric(true));
  const std::array<Vec2, 2> uv{{{0, pi / 2}, {0, 1.5}}};
  std::array<SurfaceJet, 2> jets;
  for (std::size_t i = 0; i < 2; ++i) jets[i] = s.cad.surfaces.at(1).jet(uv[i]);
  jets[0].su = {0, 0, 0};
  std::array<Metric2, 2> m;
  rules.on_surface(0, uv, jets, {}, m);
  expect_near(m[0], induced_metric(jets[0].su, jets[0].sv, 2 * std::sin(8 * pi / 180) * 0.5), 1e-9);
}

// M becomes P^T M P when u = P u'.
TEST(GeometricMetrics, AreInvariantUnderReparametrisationRotationAndScale) {
  const double a = 0.6, b = -0.4, c = 0.3, d = 0.8, angle = 0.7, scale = 4;
  const auto moved = [&](Vec3 v) {
    return scale * Vec3{std::cos(angle) * v.x() - std::sin(angle) * v.z(), v.y(),
                        std::sin(angle) * v.x() + std::cos(angle) * v.z()};
  };
  const Surface plain = paraboloid();
  const Surface other{[&](Vec2 q) {
    const SurfaceJet j = plain.jet({a * q.x() + b * q.y(), c * q.x() + d * q.y()});
    SurfaceJet k;
    k.s = moved(j.s);
    k.su = moved(a * j.su + c * j.sv);
    k.sv = moved(b * j.su + d * j.sv);
    k.suu = moved(a * a * j.suu + 2 * a * c * j.suv + c * c * j.svv);
    k.suv = moved(a * b * j.suu + (a * d + b * c) * j.suv + c * d * j.svv);
    k.svv = moved(b * b * j.suu + 2 * b * d * j.suv + d * d * j.svv);
    return k;
  }};
  for (const auto rule : {GeometricCriterion::angle, GeometricCriterion::chord, GeometricCriterion::radii}) {
    SizeParameters p = geometric(true);
    p.geo_rule = rule;
    p.eps_chord = 0.003;
    FourPatches s(plain), t(other);
    SizeRules first = s.rules(p);
    for (double* length : {&p.hgeomin, &p.hgeomax, &p.eps_chord}) *length *= scale;
    SizeRules second = t.rules(p);
    for (const Vec2& q : {Vec2{0.3, 0.2}, Vec2{-0.7, 0.5}, Vec2{0.9, 0.9}}) {
      const Metric2 m = metric_at(first, s.cad, 0, {a * q.x() + b * q.y(), c * q.x() + d * q.y()});
      const Metric2 expected{m.a * a * a + 2 * m.b * a * c + m.c * c * c,
                             m.a * a * b + m.b * (a * d + b * c) + m.c * c * d,
                             m.a * b * b + 2 * m.b * b * d + m.c * d * d};
      expect_near(metric_at(second, t.cad, 0, q), expected, 1e-12);
    }
  }
}

// HDR eq. 2.31 and 2.33 for the curve's own radius, on a plane; no bound where it is straight.
TEST(GeometricMetrics, ACurveIsKeptByItsOwnCurvature) {
  FourPatches s;
  const double radius = 0.5;
  for (const int ref : {8, 4}) {
    const double sign = ref == 8 ? 1 : -1;
    s.cad.curves[{ref, 1}] = plane_curve({0, 1}, [=](double t) -> Vec2 {
      return radius * Vec2{std::cos(sign * t), std::sin(sign * t)};
    });
  }
  for (const bool anisotropic : {false, true}) {
    SizeParameters p = geometric(anisotropic);
    EXPECT_NEAR(s.rules(p).on_curve(0, middle, 0.4), 2 * std::sin(8 * pi / 180) * radius, 1e-6);
    EXPECT_EQ(s.rules(p).on_curve(1, middle, 0.4), p.hgeomax);
    p.geo_rule = GeometricCriterion::chord;
    p.eps_chord = 0.003;
    EXPECT_NEAR(s.rules(p).on_curve(0, middle, 0.4), 2 * std::sqrt(0.003 * (2 * radius - 0.003)), 1e-6);
    p.geo_rule = GeometricCriterion::both;
    EXPECT_NEAR(s.rules(p).on_curve(0, middle, 0.4), 2 * std::sqrt(0.003 * (2 * radius - 0.003)), 1e-6);
    p.geo_guarantee = true;
    p.geo_rule = GeometricCriterion::angle;
    EXPECT_NEAR(s.rules(p).on_curve(0, middle, 0.4),
                thresholds::size::guaranteed_angle_factor * 2 * std::sin(8 * pi / 180) * radius, 1e-6);
  }
}

TEST(GeometricMetrics, ContradictionsHaveASentence) {
  const auto refused = [&](const SizeParameters& p) {
    FourPatches fresh;
    return sentence_of([&] { fresh.rules(p); });
  };
  SizeParameters p = geometric(true);
  p.geo_rule = GeometricCriterion::chord;
  EXPECT_EQ(refused(p), "geo_rule 'chord' needs a positive eps_chord; it is 0");
  p.geo_rule = GeometricCriterion::both;
  p.eps_chord = infinity;
  EXPECT_EQ(refused(p), "geo_rule 'both' needs a positive eps_chord; it is inf");
  p = geometric(true);
  p.anisotropy_max = 0.5;
  EXPECT_EQ(refused(p), "anisotropy_max must be at least 1; it is 0.5");
  p = parameters(1, 0);
  p.geo_anisotropic = true;
  EXPECT_NE(refused(p).find("hgeo_flag is 0"), std::string::npos);
  p = geometric(true);
  p.hgeomin = 2;
  EXPECT_EQ(refused(p), "hgeomin and hgeomax must be positive and ascending; they are 2 and 0.94");
}

// ---- sources ----

TEST(Sources, AMetricOfSpaceInducesAndItsTangentialSizeGovernsCurves) {
  FourPatches s;
  FieldSource source = field_of_space([](Vec3) { return Prescription::of_space(slanted); });
  for (const int hphy_flag : {1, 2}) {
    SizeParameters p = parameters(hphy_flag, 0);
    p.sources = {&source};
    s.cad.hphys = [](int, Vec2) { return std::optional<double>(); };
    SizeRules rules = s.rules(p);
    EXPECT_FALSE(rules.constant());
    expect_near(metric_at(rules, s.cad, 0, {0.3, 0.2}), {slanted.xx, slanted.xy, slanted.yy}, 1e-12);
    EXPECT_NEAR(rules.on_curve(0, middle, 0.4), 1 / std::sqrt(slanted.yy), 1e-12);
    EXPECT_NEAR(rules.on_curve(1, middle, 0.4), 1 / std::sqrt(slanted.xx), 1e-12);
    EXPECT_NEAR(rules.at_point(0), 1 / std::sqrt(slanted.yy), 1e-12);  // the smallest along four curves
    EXPECT_NEAR(rules.at_point(2), 1 / std::sqrt(slanted.xx), 1e-12);
  }
}

TEST(Sources, CurvesAndPointsWithoutAnAnswerTakeTheMeanOfTheSurfacesBeside) {
  FourPatches s;
  FieldSource source;
  const auto of_face = [](int face) { return face == 8 ? 0.2 : 0.1; };
  source.surface = [&](int face, Vec2, Vec3) {
    const double h = of_face(face);
    return Prescription::of_parameter({1 / (h * h), 0, 4 / (h * h)});
  };
  SizeParameters p = parameters(1, 0);
  p.sources = {&source};
  SizeRules rules = s.rules(p);
  EXPECT_NEAR(rules.on_curve(0, middle, 0.4), 0.075, 1e-12);  // faces 8 and 4, along v
  EXPECT_NEAR(rules.on_curve(1, middle, 0.4), 0.1, 1e-12);    // faces 4 and 1, along u
  EXPECT_NEAR(rules.on_curve(3, middle, 0.4), 0.15, 1e-12);   // faces 5 and 8, along u
  EXPECT_NEAR(rules.at_point(1), 0.075, 1e-12);
  p.mean = SizeMean::minimum;
  EXPECT_NEAR(s.rules(p).on_curve(0, middle, 0.4), 0.05, 1e-12);
}

TEST(Sources, WithoutAnswersTheSizeIsTheDefaultOrInterpolated) {
  FourPatches s;
  s.cad.hphys = [](int, Vec2) { return std::optional<double>(); };
  FieldSource source;
  source.surface = [](int, Vec2 uv, Vec3) { return uv.x() > 0.5 ? Prescription::of_space(slanted) : Prescription{}; };
  SizeParameters p = parameters(1, 0);
  p.sources = {&source};
  SizeRules rules = s.rules(p);
  expect_near(metric_at(rules, s.cad, 0, {0.6, 0.1}), {slanted.xx, slanted.xy, slanted.yy}, 1e-12);
  const double k = 1 / (p.hphydef * p.hphydef);
  expect_near(metric_at(rules, s.cad, 0, {0.4, 0.1}), {k, 0, k}, 1e-12);
  p.physical = PhysicalSizes::asked;
  SizeRules interpolating = s.rules(p);
  expect_near(metric_at(interpolating, s.cad, 0, {0.4, 0.1}), {25, 0, 25}, 1e-12);  // the metric around, by metric_at
  EXPECT_NEAR(interpolating.on_curve(0, middle, 0.4), p.hphydef, 1e-12);            // no answer at its ends either
}

TEST(Sources, AllAnswersCount) {
  FourPatches s;
  s.cad.hphys = [](int, Vec2) { return std::optional<double>(0.15); };
  FieldSource first = field_of_space([](Vec3) { return Prescription::of_space({100, 0, 0, 1, 0, 1}); });
  FieldSource second = field_of_space([](Vec3) { return Prescription::of_size(0.5); });
  SizeParameters p = parameters(1, 0);
  p.hphymax = 10;
  p.sources = {&first, &second};
  SizeRules rules = s.rules(p);
  expect_near(metric_at(rules, s.cad, 0, {0.6, 0.1}), {100, 0, 4}, 1e-12);
  p.physical = PhysicalSizes::asked;  // and the size routine
  SizeRules three = s.rules(p);
  expect_near(metric_at(three, s.cad, 0, {0.6, 0.1}), {100, 0, 1 / (0.15 * 0.15)}, 1e-12);
  p.physical = PhysicalSizes::ignored;
  p.geometric = GeometricSizes::curvature;
  EXPECT_FALSE(s.rules(p).uses_metrics());
}

TEST(Sources, SizesInTheTangentPlaneAreClamped) {
  FourPatches s;
  FieldSource source = field_of_space([](Vec3) { return Prescription::of_space({1e6, 0, 0, 1e-6, 0, 1}); });
  SizeParameters p = parameters(1, 0);
  p.sources = {&source};
  SizeRules rules = s.rules(p);
  const auto k = [](double h) { return 1 / (h * h); };
  expect_near(metric_at(rules, s.cad, 0, {0.6, 0.1}), {k(p.hphymin), 0, k(p.hphymax)}, 1e-12);
  EXPECT_NEAR(rules.on_curve(1, middle, 0.4), p.hphymin, 1e-12);
  EXPECT_NEAR(rules.on_curve(0, middle, 0.4), p.hphymax, 1e-12);
}

// RR-2928 sec. 5.3 on a cylinder: the geometry prescribes h1 along u, hgeomax along v.
TEST(Sources, AreCombinedWithTheGeometryInOneOfTwoWays) {
  FourPatches s(cylinder(0.7));
  const double h1 = 2 * std::sin(8 * pi / 180) * 0.7;
  FieldSource source = field_of_space([](Vec3) { return Prescription::of_size(0.5); });
  SizeParameters p = parameters(1, 1);
  p.geo_anisotropic = true;
  p.sources = {&source};
  const Vec2 uv{0.3, 0.2};
  const SurfaceJet jet = s.cad.surfaces.at(1).jet(uv);
  SizeRules both = s.rules(p);
  EXPECT_NEAR(size_along(metric_at(both, s.cad, 0, uv), jet, {1, 0}), h1, 1e-12);
  EXPECT_NEAR(size_along(metric_at(both, s.cad, 0, uv), jet, {0, 1}), 0.5, 1e-12);
  EXPECT_NEAR(both.on_curve(0, middle, 0.4), 0.5, 1e-12);
  p.metric_combination = MetricCombination::scale;
  SizeRules scaled = s.rules(p);
  EXPECT_NEAR(size_along(metric_at(scaled, s.cad, 0, uv), jet, {1, 0}), h1, 1e-12);
  EXPECT_NEAR(size_along(metric_at(scaled, s.cad, 0, uv), jet, {0, 1}), h1, 1e-12);
  EXPECT_NEAR(scaled.on_curve(0, middle, 0.4), h1, 1e-12);
  EXPECT_NEAR(scaled.ask_on_curve(0, middle, 0.4).physical, 0.5, 1e-12);
}

TEST(Sources, UnusableMetricsHaveASentenceWithThePlaceAndTheMatrix) {
  FourPatches s;
  Prescription answer;
  FieldSource source = field_of_space([&](Vec3) { return answer; });
  SizeParameters p = parameters(1, 0);
  p.sources = {&source};
  const auto refused = [&](const Prescription& bad) {
    answer = bad;
    SizeRules rules = s.rules(p);
    return sentence_of([&] { metric_at(rules, s.cad, 0, {0.5, 0.25}); });
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(
      refused(Prescription::of_space({1, 2, 0, 1, 0, 1})),
      "face 1, u = 0.5, v = 0.25: the prescription of sizes returned the metric (xx, xy, xz, yy, yz, zz) = (1, 2, 0, "
      "1, 0, 1), which is not positive definite");
  EXPECT_NE(refused(Prescription::of_space({1, 0, 0, nan, 0, 1})).find("which is not finite"), std::string::npos);
  EXPECT_EQ(
      refused(Prescription::of_parameter({1, 1, 1})),
      "face 1, u = 0.5, v = 0.25: the prescription of sizes returned the metric (a, b, c) = (1, 1, 1), which is not "
      "positive definite");
  EXPECT_NE(refused(Prescription::of_size(nan)).find("which is not a finite number"), std::string::npos);
  answer = Prescription::of_space({1, 0, 0, -1, 0, 1});
  SizeRules rules = s.rules(p);
  EXPECT_EQ(sentence_of([&] { rules.on_curve(0, middle, 0.4); }).find("face 8, curve 1"), 0U);
  EXPECT_EQ(sentence_of([&] { rules.at_point(0); }).find("point of reference 6: "), 0U);
}

}  // namespace
