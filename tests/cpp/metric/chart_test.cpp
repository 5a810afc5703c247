// SPDX-License-Identifier: BSD-3-Clause
// Charts of metrics that are induced by maps of the plane onto itself: distances in space are then known exactly.
#include "metric/chart.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace carreau {
namespace {

// Turns by an angle that grows with the distance: area is kept, shapes shear.
constexpr double turns = 1.5;
Vec2 swirl(Vec2 p) {
  const double g = turns * dot(p, p), x = std::cos(g), y = std::sin(g);
  return {x * p.x() - y * p.y(), y * p.x() + x * p.y()};
}
// J^T J with J = R (I + turns Q p (2 p)^T): in closed form.
Metric2 metric(Vec2 p) {
  const Vec2 q{-p.y(), p.x()};
  const Vec2 u = Vec2{1, 0} + (2 * turns * p.x()) * q, v = Vec2{0, 1} + (2 * turns * p.y()) * q;
  return {dot(u, u), dot(u, v), dot(v, v)};
}
MetricSlopes slopes(Vec2 p) {
  constexpr double e = 1e-5;
  const auto difference = [&](Vec2 d) { return (0.5 / e) * (metric(p + e * d) + -1.0 * metric(p + -e * d)); };
  return {metric(p), difference({1, 0}), difference({0, 1})};
}

double largest_error(double h, bool curved) {
  const Vec2 p{0.6, 0.3};
  const Chart chart = curved ? Chart(p, slopes(p)) : Chart(p, {metric(p), {0, 0, 0}, {0, 0, 0}});
  double worst = 0;
  for (int k = 0; k < 12; ++k) {
    const double a = 2 * std::numbers::pi * k / 12;
    const Vec2 q = p + h * Vec2{std::cos(a), std::sin(a)};
    worst = std::max(worst, std::abs(norm(chart.at(q)) - norm(swirl(q) - swirl(p))));
  }
  return worst;
}

TEST(Chart, GivesDistancesToThirdOrder) {
  const double tensor = std::log2(largest_error(0.02, false) / largest_error(0.01, false));
  const double chart = std::log2(largest_error(0.02, true) / largest_error(0.01, true));
  EXPECT_NEAR(tensor, 2, 0.1);
  EXPECT_NEAR(chart, 3, 0.1);
  EXPECT_LT(largest_error(0.01, true), 0.05 * largest_error(0.01, false));
}

TEST(Chart, IsInvertedAndKeepsOrientation) {
  const Vec2 p{0.6, 0.3};
  const Chart chart(p, slopes(p));
  for (int k = 0; k < 12; ++k) {
    const double a = 2 * std::numbers::pi * k / 12, b = a + 0.5;
    const Vec2 q = p + 0.1 * Vec2{std::cos(a), std::sin(a)}, r = p + 0.1 * Vec2{std::cos(b), std::sin(b)};
    EXPECT_LT(norm(chart.point(chart.at(q), p) - q), 1e-7);
    EXPECT_GT(cross(chart.at(q), chart.at(r)), 0);
  }
}

// e^(2 f) times a constant tensor: sizes vary, shapes do not.
TEST(Chart, SizesAloneDoNotBendShapes) {
  const Metric2 m{3, 1, 2};
  const MetricSlopes s{m, 0.7 * m, -0.4 * m};
  EXPECT_NEAR(bend_of_shapes(s), 0, 1e-15);
  EXPECT_GT(Chart({}, s).bend(), 0.1);
}

// A metric of unit lengths h times as long bends 1 / h times as much.
TEST(Chart, BendIsInUnitLengths) {
  const MetricSlopes s = slopes({0.6, 0.3});
  const MetricSlopes finer{100.0 * s.metric, 100.0 * s.by_u, 100.0 * s.by_v};
  EXPECT_NEAR(bend_of_shapes(finer), 0.1 * bend_of_shapes(s), 1e-9);
}

}  // namespace
}  // namespace carreau
