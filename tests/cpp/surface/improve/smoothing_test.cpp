// SPDX-License-Identifier: BSD-3-Clause
// Shapes in space where the parameter plane misleads: at poles, and where the metric changes much within an edge.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "mesh/quality.h"
#include "session_of_size.h"

namespace carreau {
namespace {

using testing::AnalyticCad;
constexpr double degree = std::numbers::pi / 180;

/// A sector of a saddle, of radius 1.5, whose apex is a side of the parameter plane; uneven in angle and in radius.
AnalyticCad sector(double opening) {
  const auto jet = [opening](Vec2 p) {
    const double r = p.y() + p.y() * p.y() / 2, dr = 1 + p.y(), w = opening * (p.x() + p.x() * p.x()) / 2;
    const double dw = opening * (1 + 2 * p.x()) / 2, c = std::cos(w), s = std::sin(w), c2 = std::cos(2 * w);
    const double s2 = std::sin(2 * w), ddw = opening, ddr = 1;
    SurfaceJet j;
    j.s = {r * c, r * s, 0.2 * r * r * c2};
    j.su = {-r * s * dw, r * c * dw, -0.4 * r * r * s2 * dw};
    j.sv = {dr * c, dr * s, 0.4 * r * dr * c2};
    j.suu = {-r * (c * dw * dw + s * ddw), r * (c * ddw - s * dw * dw), -0.4 * r * r * (2 * c2 * dw * dw + s2 * ddw)};
    j.suv = {-dr * s * dw, dr * c * dw, -0.8 * r * dr * s2 * dw};
    j.svv = {ddr * c, ddr * s, 0.4 * (dr * dr + r * ddr) * c2};
    return j;
  };
  AnalyticCad cad;
  cad.faces[1] = {jet, testing::rectangle({0, 0}, {1, 1})};
  return cad;
}

// A fan of three triangles, which apexes that faces surround need, would have angles of 20 degrees in a corner of 60: a
// quality of .56.
TEST(SpaceSmoothing, ApexesOfSectorsHaveGoodTriangles) {
  Monitor monitor;
  for (const double opening : {60., 90., 135., 200.})
    for (int k = 0; k < 12; ++k) {
      const double size = 0.04 * std::pow(1.2, k);
      SCOPED_TRACE(std::to_string(opening) + " degrees, size " + std::to_string(size));
      const auto session = testing::session_of_size(sector(opening * degree), size, monitor);
      session->make_mesh();
      EXPECT_EQ(find_defects(session->mesh(), {.limit = 5}), std::vector<std::string>{});
      // Three triangles of 30 degrees in a right angle: 4 sqrt(3) sin(30) / (8 - 4 cos(30)) = 0.764.
      EXPECT_GT(summarise_quality(session->exported()).q2.min, opening < 90 ? 0.78 : 0.74);
    }
}

}  // namespace
}  // namespace carreau
