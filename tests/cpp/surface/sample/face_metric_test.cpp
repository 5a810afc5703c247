// SPDX-License-Identifier: BSD-3-Clause
// Prescribed sizes inside a face, where its parametrisation is degenerate.
#include "surface/sample/face_metric.h"

#include <gtest/gtest.h>

#include <numbers>

#include "common/analytic_cad.h"
#include "geometric_run.h"

namespace carreau {
namespace {

using namespace testing;
constexpr double pi = std::numbers::pi;

/// A whole ellipsoid of three axes, and its domain: a rectangle whose lower and upper sides are poles.
struct Ellipsoid {
  AnalyticCad cad = one_face(
      [](Vec2 p) {
        return ellipsoid_jet(p, {1, 2, 5});
      },
      rectangle({0, -pi / 2}, {2 * pi, pi / 2}));
  Model model;
  Topology topology;
  PlaneDomain plane;
  std::vector<double> physical;
  Monitor monitor;

  Ellipsoid() {
    model.faces.push_back({.ref = 1, .curves = {}, .points = {}});
    for (const Vec2& p : {Vec2{0, -pi / 2}, Vec2{2 * pi, -pi / 2}, Vec2{2 * pi, pi / 2}, Vec2{0, pi / 2}})
      plane.vertices.push_back(p);
    for (int i = 0; i < 4; ++i) plane.edges.push_back({.a = i, .b = (i + 1) % 4});
  }
  SizeRules rules() {
    SizeParameters p;
    p.physical = PhysicalSizes::ignored, p.geometric = GeometricSizes::curvature, p.geo_anisotropic = true;
    p.hgeomin = 1e-3, p.hgeomax = 10;
    return {model, topology, cad, p};
  }
  std::vector<Metric2> at(const SizeRules& rules, std::span<const Vec2> uv) {
    FaceMetric metric(0, rules, plane, physical, monitor);
    std::vector<SurfaceJet> jets(uv.size());
    cad.surface(1, metric.wants(), uv, jets);
    std::vector<Metric2> m(uv.size());
    metric.at(uv, jets, m);
    return m;
  }
};

// Metrics of a pole and of the places beside it: alone, among others, last and first.
TEST(FaceMetric, AtAPoleDoesNotDependOnTheOthersOfItsBatch) {
  Ellipsoid e;
  const SizeRules rules = e.rules();
  std::vector<Vec2> uv;
  for (int i = 0; i <= 12; ++i)
    for (const double v : {-pi / 2, 0.3, pi / 2}) uv.push_back({2 * pi * i / 12, v});
  const std::vector<Metric2> together = e.at(rules, uv);
  const std::vector<Vec2> back(uv.rbegin(), uv.rend());
  const std::vector<Metric2> backwards = e.at(rules, back);
  for (std::size_t k = 0; k < uv.size(); ++k) {
    const Metric2 alone = e.at(rules, {&uv[k], 1})[0];
    for (const Metric2 m : {together[k], backwards[uv.size() - 1 - k]}) {
      EXPECT_EQ(m.a, alone.a) << k;
      EXPECT_EQ(m.b, alone.b) << k;
      EXPECT_EQ(m.c, alone.c) << k;
    }
  }
}

// The limit along each meridian, from inside: distances along it are continuous.
TEST(FaceMetric, AtAPoleIsTheLimitAlongItsMeridian) {
  Ellipsoid e;
  const SizeRules rules = e.rules();
  for (int i = 0; i <= 12; ++i)
    for (const double sign : {-1., 1.}) {
      const double u = 2 * pi * i / 12;
      const std::vector<Metric2> m = e.at(rules, std::vector<Vec2>{{u, sign * pi / 2}, {u, sign * (pi / 2 - 1e-3)}});
      EXPECT_NEAR(m[0].c / m[1].c, 1, 1e-2) << u;
    }
}

}  // namespace
}  // namespace carreau
