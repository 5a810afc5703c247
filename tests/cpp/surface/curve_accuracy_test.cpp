// SPDX-License-Identifier: BSD-3-Clause
// Edges of curves against their curves (HDR sec. 2.6): A0 and A1 in closed form, limits, and the guarantee of
// geo_guarantee.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometric_run.h"
#include "session_of_size.h"

namespace carreau {
namespace {

using namespace testing;
using Kind = EvaluationKind;
constexpr double pi = std::numbers::pi;

SurfaceJet plane_jet(Vec2 p) { return {{p.x(), p.y(), 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}}; }
AnalyticCad disc() { return one_face(plane_jet, {arc({0, 0}, 1, 0, pi), arc({0, 0}, 1, pi, 2 * pi)}); }

struct Meshed {
  Monitor monitor;
  std::unique_ptr<Session> session;

  template <typename Set>
  Meshed(const AnalyticCad& cad, double size, const Set& set) : session(session_of_size(cad, size, monitor)) {
    set(session->parameters());
    session->make_mesh();
  }
  [[nodiscard]] const MeshEvaluation& delivered() const { return session->delivered(); }
  /// Values of edges of curves.
  [[nodiscard]] std::vector<double> values(Kind kind) const {
    std::vector<double> known = delivered()[kind].values;
    std::erase_if(known, [](double x) { return std::isnan(x); });
    return known;
  }
  [[nodiscard]] std::int64_t curve_edges() const {
    std::int64_t count = 0;
    for (const CurveMesh& curve : session->mesh().curves)  // curves that vanish have no vertices
      count += std::max<std::int64_t>(static_cast<std::int64_t>(curve.vertices.size()), 1) - 1;
    return count;
  }
  [[nodiscard]] bool told(const std::string& part) const {
    const std::vector<std::string> not_met = describe(delivered()).not_met;
    return std::ranges::any_of(not_met, [&](const std::string& s) { return s.find(part) != std::string::npos; });
  }
};

TEST(CurveAccuracy, ChordsOfACircleHaveTheirClosedForms) {
  for (const double size : {1.0, 0.3, 0.1}) {
    const Meshed run(disc(), size, [](Parameters&) {});
    const std::vector<double> a0 = run.values(Kind::curve_deviation), a1 = run.values(Kind::curve_angle);
    ASSERT_EQ(static_cast<std::int64_t>(a0.size()), run.curve_edges());
    const double half = pi / static_cast<double>(a0.size());  // of the angle that an edge spans
    for (const double x : a0) EXPECT_NEAR(x, 1 - std::cos(half), 1e-9);
    for (const double x : a1) EXPECT_NEAR(x, half * 180 / pi, 2e-4);  // the ends are looked at from beside
    EXPECT_EQ(run.delivered()[Kind::curve_angle].spread.count, run.curve_edges());
  }
}

TEST(CurveAccuracy, FourEdgesOfADiscAreReportedForASmallAngle) {
  const auto asked = [](double angle, int guarantee) {
    return Meshed(disc(), 1, [=](Parameters& p) {
      p.set("hphy_flag", 0), p.set("hgeo_flag", 1), p.set("angle_mesh", angle), p.set("geo_guarantee", guarantee);
      p.set("hgeomin", 1e-3), p.set("hgeomax", 10.0);
    });
  };
  const Meshed coarse = asked(40.2, 0);
  ASSERT_EQ(coarse.curve_edges(), 4);
  EXPECT_NEAR(coarse.delivered()[Kind::curve_angle].spread.max, 45, 1e-3);
  EXPECT_NEAR(coarse.delivered()[Kind::curve_deviation].spread.max, 1 - std::sqrt(0.5), 1e-9);
  EXPECT_EQ(coarse.delivered()[Kind::curve_angle].beyond, 4);
  EXPECT_TRUE(coarse.told("4 of 4 edges of curves (100 %) have an angle with a tangent of their curve of more than the 40.2"));
  for (double angle = 50; angle > 2; angle *= 0.93) {
    const Meshed kept = asked(angle, 1);
    EXPECT_LE(kept.delivered()[Kind::curve_angle].spread.max, angle) << angle;
    EXPECT_FALSE(kept.told("of their curve")) << angle;
  }
}

TEST(CurveAccuracy, DistancesAreLimitedToo) {
  for (const double eps : {0.2, 0.05, 0.013, 0.002}) {
    const Meshed kept(disc(), 1, [=](Parameters& p) {
      p.set("hphy_flag", 0), p.set("hgeo_flag", 1), p.set("geo_rule", "chord"), p.set("eps_chord", eps);
      p.set("geo_guarantee", 1), p.set("hgeomin", 1e-3), p.set("hgeomax", 10.0);
    });
    EXPECT_EQ(kept.delivered()[Kind::curve_deviation].limit, eps);
    EXPECT_LE(kept.delivered()[Kind::curve_deviation].spread.max, eps);
  }
}

TEST(CurveAccuracy, ParabolasOfSecondOrderAreOfOrderFour) {
  const auto errors = [](double size) {
    const Meshed run(disc(), size, [](Parameters& p) { p.set("element", "p2"); });
    const MeshEvaluation& d = run.delivered();
    return std::array{d[Kind::curve_deviation].spread.max, d[Kind::curve_angle].spread.max,
                      static_cast<double>(run.curve_edges())};
  };
  const auto coarse = errors(0.4), fine = errors(0.1);
  const double halvings = std::log2(fine[2] / coarse[2]);
  EXPECT_NEAR(std::log2(coarse[0] / fine[0]) / halvings, 4, 0.1);
  EXPECT_NEAR(std::log2(coarse[1] / fine[1]) / halvings, 3, 0.1);
}

TEST(CurveAccuracy, KinksAreSeen) {
  // y = |x - .3| / 2 below, of one curve: an edge over the kink is off by the angle of one side.
  AnalyticCurve roof = segment({-1, 0}, {1, 0});
  roof.at = [](double t) {
    const double x = 2 * t - 1, slope = x < 0.3 ? -0.5 : 0.5;
    return CurveJet{{x, std::abs(x - 0.3) / 2}, {2, 2 * slope}, {0, 0}};
  };
  AnalyticCad cad = one_face(plane_jet, {roof, segment({1, 0.35}, {1, 2}), segment({1, 2}, {-1, 2}), segment({-1, 2}, {-1, 0.65})});
  const Meshed run(cad, 0.35, [](Parameters&) {});
  const std::vector<double> angles = run.values(Kind::curve_angle), distances = run.values(Kind::curve_deviation);
  EXPECT_EQ(std::ranges::count_if(angles, [](double x) { return x > 1e-6; }), 1);
  EXPECT_EQ(std::ranges::count_if(distances, [](double x) { return x > 1e-9; }), 1);
}

TEST(CurveAccuracy, LinesOfIndependentMeshesAreMeasuredToo) {
  // A cylinder of four strips: its circles stay, cut anew.
  const int strips = 4;
  AnalyticCad cad;
  const auto cylinder = [](Vec2 p) {
    return SurfaceJet{{std::cos(p.x()), std::sin(p.x()), p.y()}, {-std::sin(p.x()), std::cos(p.x()), 0}, {0, 0, 1},
                      {-std::cos(p.x()), -std::sin(p.x()), 0}, {}, {}};
  };
  for (int k = 0; k < strips; ++k)
    cad.faces[k + 1] = {cylinder, rectangle({k * 2 * pi / strips, 0}, {(k + 1) * 2 * pi / strips, 1})};
  const Meshed run(cad, 0.3, [](Parameters& p) { p.set("patches", "independent"); });
  ASSERT_TRUE(run.session->mesh().independent);
  const std::vector<double> a0 = run.values(Kind::curve_deviation), a1 = run.values(Kind::curve_angle);
  ASSERT_EQ(static_cast<std::int64_t>(a0.size()), run.curve_edges());
  const SurfaceMesh& mesh = run.session->mesh();
  const MeshEdges& edges = run.delivered().edges;
  for (std::size_t e = 0; e < edges.vertices.size(); ++e) {
    if (edges.segment[e] < 0) continue;
    const Vec3 p = mesh.vertices[edges.vertices[e][0]], q = mesh.vertices[edges.vertices[e][1]];
    ASSERT_EQ(p.z(), q.z());
    const double half = std::asin(norm(q - p) / 2);
    EXPECT_NEAR(run.delivered()[Kind::curve_deviation].values[e], 1 - std::cos(half), 1e-9);
    EXPECT_NEAR(run.delivered()[Kind::curve_angle].values[e], half * 180 / pi, 1e-3);
  }
}

TEST(CurveAccuracy, TrianglesHaveTheAnglesOfTheirVertices) {
  // RT-0232 sec. 3.3: the plane of a triangle and the tangent planes at its three vertices. On a sphere all three
  // angles are asin of the radius of the circle around.
  const Meshed run(sphere(), 0.3, [](Parameters&) {});
  const SurfaceMesh& mesh = run.session->mesh();
  for (std::size_t t = 0; t < mesh.faces[0].triangles.size(); ++t) {
    const auto& c = mesh.faces[0].triangles[t];
    const Vec3 p = mesh.vertices[mesh.faces[0].vertex[c[0]]], q = mesh.vertices[mesh.faces[0].vertex[c[1]]],
               r = mesh.vertices[mesh.faces[0].vertex[c[2]]];
    const Vec3 normal = cross(q - p, r - p);
    const double expected = std::acos(std::min(1.0, dot(p, normal) / norm(normal))) * 180 / pi;
    EXPECT_NEAR(run.delivered()[Kind::vertex_angle].values[t], expected, 1e-5);
  }
}

}  // namespace
}  // namespace carreau
