// SPDX-License-Identifier: BSD-3-Clause
// Strips of one layer of triangles, whose sides face each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "mesh/quality.h"
#include "session_of_size.h"

namespace carreau {
namespace {

using testing::AnalyticCad;
constexpr double pi = std::numbers::pi;

SurfaceJet flat(Vec2 p) { return {{p.x(), p.y(), 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}}; }
SurfaceJet round(Vec2 p) {
  const double c = std::cos(p.x()), s = std::sin(p.x());
  return {{2 * c, 2 * s, p.y()}, {-2 * s, 2 * c, 0}, {0, 0, 1}, {-2 * c, -2 * s, 0}, {}, {}};
}

AnalyticCad patch(SurfaceJet (*surface)(Vec2), std::vector<testing::AnalyticCurve> curves) {
  AnalyticCad cad;
  cad.faces[1] = {surface, std::move(curves)};
  return cad;
}

std::unique_ptr<Session> meshed(const AnalyticCad& cad, double size, int stagger, Monitor& monitor) {
  auto session = testing::session_of_size(cad, size, monitor);
  session->parameters().set("stagger_strips", stagger);
  session->make_mesh();
  EXPECT_EQ(find_defects(session->mesh(), {.limit = 5}), std::vector<std::string>{});
  return session;
}

double mean_quality(const Session& session) { return summarise_quality(session.exported()).q2.mean; }
double worst_quality(const Session& session) { return summarise_quality(session.exported()).q2.min; }

// Q2 of triangles over edges a times as long as a strip is wide.
double right_angled(double a) { return std::sqrt(3.) * a / (1 + a * a); }
double isosceles(double a) { return 2 * std::sqrt(3.) * a / (1.5 * a * a + 2); }

TEST(Staggering, StripsAreOfIsoscelesTriangles) {
  Monitor monitor;
  for (const double width : {0.2, 0.4, 0.6, 0.75, 0.9, 1.1}) {
    SCOPED_TRACE(width);
    const AnalyticCad cad = patch(flat, testing::rectangle({0, 0}, {40, width}));
    EXPECT_NEAR(mean_quality(*meshed(cad, 1, 0, monitor)), right_angled(1 / width), 1e-6);
    const auto session = meshed(cad, 1, 1, monitor);
    // 40 edges on one side, 39 and two halves on the other one.
    EXPECT_NEAR(mean_quality(*session), (79 * isosceles(1 / width) + 2 * right_angled(0.5 / width)) / 81, 1e-6);
    EXPECT_NEAR(worst_quality(*session), std::min(isosceles(1 / width), right_angled(0.5 / width)), 1e-6);
  }
}

// Two closed curves and a seam; the vertex that closes a curve stays.
TEST(Staggering, RingsToo) {
  Monitor monitor;
  const AnalyticCad cad = patch(round, testing::rectangle({0, 0}, {2 * pi, 0.5}));
  const double before = mean_quality(*meshed(cad, 0.8, 0, monitor));
  const auto session = meshed(cad, 0.8, 1, monitor);
  EXPECT_LT(before, 0.87);
  EXPECT_GT(mean_quality(*session), 0.9);
}

TEST(Staggering, WideFacesAndSharpCornersStayAsTheyAre) {
  Monitor monitor;
  const std::vector<testing::AnalyticCurve> wedge = {
      testing::segment({0, 0}, {10, 0}), testing::segment({10, 0}, {10, 2}), testing::segment({10, 2}, {0, 0})};
  for (const AnalyticCad& cad : {patch(flat, testing::rectangle({0, 0}, {10, 6})), patch(flat, wedge)}) {
    const auto positions = [&](int stagger) {
      std::vector<double> all;
      const auto session = meshed(cad, 0.5, stagger, monitor);
      for (const Vec3& p : session->mesh().vertices) all.insert(all.end(), {p.x(), p.y(), p.z()});
      return all;
    };
    EXPECT_EQ(positions(0), positions(1));
  }
}

}  // namespace
}  // namespace carreau
