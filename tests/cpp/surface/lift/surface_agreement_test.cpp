// SPDX-License-Identifier: BSD-3-Clause
// Triangles that would lean against the surface, or fold over: long sizes are bounded, and remaining triangles are
// reported.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "common/analytic_cad.h"
#include "common/field_source.h"
#include "gradation/metric_grading.h"
#include "measure/mesh_evaluation.h"
#include "metric/metric3_algebra.h"
#include "session/session.h"
#include "support/infinity.h"

namespace carreau {
namespace {

using namespace testing;
constexpr double pi = std::numbers::pi;

// ---- the bound ----

SurfaceJet cylinder_jet(Vec2 p, double radius) {
  const double c = std::cos(p.x()), s = std::sin(p.x());
  return {
      {radius * c, radius * s, p.y()}, {-radius * s, radius * c, 0}, {0, 0, 1}, {-radius * c, -radius * s, 0}, {}, {}};
}
SurfaceJet polar_jet(Vec2 p) {
  const double c = std::cos(p.y()), s = std::sin(p.y());
  return {{p.x() * c, p.x() * s, 0},  {c, s, 0}, {-p.x() * s, p.x() * c, 0}, {}, {-s, c, 0},
          {-p.x() * c, -p.x() * s, 0}};
}
double bounded(const SurfaceJet& jet, Vec3 short_way, Vec3 long_way, double h1, double h2, double lean) {
  TangentMetric sizes{short_way, long_way, h1, h2};
  bound_lean(jet, lean, sizes);
  EXPECT_EQ(sizes.h1, h1);
  return sizes.h2;
}

// The arrow of a chord of length L of a circle of radius R is L^2 / (8 R), to second order.
TEST(BoundOfLean, MatchesTheArrowOfAChord) {
  for (const double radius : {0.1, 1., 30.})
    for (const double h : {1e-4, 1e-3})
      for (const double lean : {0.2, 0.5, 1.}) {
        const SurfaceJet jet = cylinder_jet({0.3, 0.1}, radius);
        const Vec3 around = (1 / radius) * jet.su, along = jet.sv;
        EXPECT_NEAR(bounded(jet, along, around, h * radius, infinity, lean), std::sqrt(8 * lean * h) * radius,
                    1e-12 * radius);
        EXPECT_EQ(bounded(jet, around, along, h * radius, 1e3 * radius, lean), 1e3 * radius);
      }
}

TEST(BoundOfLean, LeavesShortEdgesAndNeverGoesBelowTheOtherSize) {
  const SurfaceJet jet = cylinder_jet({0, 0}, 1);
  EXPECT_EQ(bounded(jet, {0, 0, 1}, {0, 1, 0}, 0.01, 0.05, 0.5), 0.05);
  EXPECT_EQ(bounded(jet, {0, 0, 1}, {0, 1, 0}, 20, 21, 0.5), 20);
  EXPECT_EQ(bounded(jet, {0, 0, 1}, {0, 1, 0}, 1, 1, 0.5), 1);
}

// In the plane, too, images of segments of (u, v) bend where the parametrisation does: circles about a pole. They turn
// by half a radian at most.
TEST(BoundOfLean, KnowsHowImagesOfSegmentsBend) {
  for (const double r : {0.02, 1., 5.}) {
    const SurfaceJet jet = polar_jet({r, 0.7});
    const double h = 1e-3, most = std::min(std::sqrt(8 * 0.5 * h * r), r);
    EXPECT_NEAR(bounded(jet, jet.su, (1 / r) * jet.sv, h, infinity, 0.5), std::max(h, most), 1e-12);
  }
}

// Under (u, v) -> A (u, v) nothing changes.
TEST(BoundOfLean, DoesNotDependOnALinearChangeOfParameters) {
  const SurfaceJet j = torus_jet({0.4, 1.1}, 3, 1);
  const double a = 2, b = 0.7, c = -0.3, d = 5;
  SurfaceJet k = j;
  k.su = a * j.su + c * j.sv, k.sv = b * j.su + d * j.sv;
  k.suu = (a * a) * j.suu + (2 * a * c) * j.suv + (c * c) * j.svv;
  k.suv = (a * b) * j.suu + (a * d + b * c) * j.suv + (c * d) * j.svv;
  k.svv = (b * b) * j.suu + (2 * b * d) * j.suv + (d * d) * j.svv;
  const Vec3 e = (1 / norm(j.su)) * j.su, f = (1 / norm(j.sv)) * j.sv;
  for (const double angle : {0., 0.4, 1.2, 2.5}) {
    const Vec3 p = std::cos(angle) * e + std::sin(angle) * f, q = std::cos(angle) * f - std::sin(angle) * e;
    const double h = bounded(j, p, q, 1e-3, infinity, 0.5);
    EXPECT_NEAR(bounded(k, p, q, 1e-3, infinity, 0.5), h, 1e-9 * h);
  }
}

// ---- meshes ----

/// z = f over a square of side 2, as a function of f and its first and second derivatives.
struct Graph {
  const char* name;
  std::array<double, 6> (*at)(double x, double y);  // f, fx, fy, fxx, fxy, fyy
};
std::array<double, 6> waves(double x, double y) {
  const double s = std::sin(6 * x), c = std::cos(6 * x), t = std::sin(6 * y), d = std::cos(6 * y);
  return {0.1 * s * t, 0.6 * c * t, 0.6 * s * d, -3.6 * s * t, 3.6 * c * d, -3.6 * s * t};
}
std::array<double, 6> bowl(double x, double y) { return {(x * x + y * y) / 2, x, y, 1, 0, 1}; }

struct Warnings : Monitor {
  std::vector<std::string> told;
  void message(Level level, std::string_view text) override {
    if (level == Level::warning) told.emplace_back(text);
  }
};

/// Sizes h along (cos a, sin a) in the plane and `ratio` h across, a = u + 2 v.
struct Turning {
  Warnings monitor;
  Session session{monitor};
  double of_surface = 0;

  Turning(const Graph& graph, double h, double ratio) {
    const auto at = graph.at;
    auto cad = std::make_shared<AnalyticCad>();
    cad->faces[1] = {
        [at](Vec2 p) {
          const auto f = at(p.x(), p.y());
          return SurfaceJet{{p.x(), p.y(), f[0]}, {1, 0, f[1]}, {0, 1, f[2]}, {0, 0, f[3]}, {0, 0, f[4]}, {0, 0, f[5]}};
        },
        rectangle({-1, -1}, {1, 1})};
    session.set_cad(cad);
    session.set_model(unglued(*cad));
    session.set_metric_callbacks(std::make_shared<testing::FieldSource>(testing::field_of_space([at, h, ratio](Vec3 p) {
      const auto f = at(p.x(), p.y());
      const double a = p.x() + 2 * p.y(), c = std::cos(a), s = std::sin(a);
      return Prescription::of_space(metric_of_sizes({c, s, c * f[1] + s * f[2]}, h, ratio * h));
    })));
    session.parameters().set("hphymin", h / 10);
    session.parameters().set("hphymax", 10.0);
    session.make_mesh();
    constexpr int n = 400;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const auto f = at(2 * (i + 0.5) / n - 1, 2 * (j + 0.5) / n - 1);
        of_surface += 4. / (n * n) * std::sqrt(1 + f[1] * f[1] + f[2] * f[2]);
      }
  }
  [[nodiscard]] const FaceMesh& face() const { return session.mesh().faces[0]; }
  [[nodiscard]] double area() const {
    double sum = 0;
    for (const auto& t : face().triangles) {
      const auto at = [&](int i) { return session.mesh().vertices[face().vertex[t[i]]]; };
      sum += norm(cross(at(1) - at(0), at(2) - at(0))) / 2;
    }
    return sum;
  }
};

class Leaning : public ::testing::TestWithParam<Graph> {};

// Edges of a hundred times the short size leave the surface by more than that: with the sizes prescribed areas are 12
// to 16 % too large.
TEST_P(Leaning, TrianglesOfRatio100LieOnTheSurface) {
  Turning run(GetParam(), 0.01, 100);
  EXPECT_EQ(find_defects(run.session.mesh()), std::vector<std::string>{});
  EXPECT_LE(run.area(), 1.05 * run.of_surface);
  EXPECT_GE(run.area(), 0.97 * run.of_surface);
  EXPECT_EQ(run.session.delivered().folded_triangles, 0);
  // A warning and the reason of the face report that sizes differ from the prescribed sizes.
  EXPECT_EQ(run.face().status, FaceStatus::mended);
  EXPECT_NE(run.face().why.find("face 1: with the sizes prescribed: "), std::string::npos) << run.face().why;
  EXPECT_NE(run.face().why.find("long sizes are bounded by the curvature"), std::string::npos);
  EXPECT_EQ(std::count(run.monitor.told.begin(), run.monitor.told.end(), run.face().why), 1);
}

// Edges that lie on the surface are left alone.
TEST_P(Leaning, ShortEdgesAreNotBounded) {
  Turning run(GetParam(), 0.02, 5);
  EXPECT_LE(run.area(), 1.02 * run.of_surface);
  EXPECT_EQ(run.face().status, FaceStatus::meshed) << run.face().why;
  EXPECT_TRUE(run.monitor.told.empty());
}

INSTANTIATE_TEST_SUITE_P(Surfaces, Leaning, ::testing::Values(Graph{"waves", waves}, Graph{"bowl", bowl}),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace carreau
