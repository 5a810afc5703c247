// SPDX-License-Identifier: BSD-3-Clause
#include "control_space/even_space.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "metric/metric2_algebra.h"
#include "support/error.h"

namespace carreau {
namespace {

constexpr double pi = std::numbers::pi;

SampledDomain disc(double radius, int n) {
  SampledDomain domain;
  for (int k = 0; k < n; ++k) {
    domain.vertices.emplace_back(radius * std::cos(2 * pi * k / n), radius * std::sin(2 * pi * k / n));
    domain.edges.emplace_back(k, (k + 1) % n);
  }
  return domain;
}

SampledDomain rectangle(const Vec2& low, const Vec2& high) {
  return {{low, {high.x(), low.y()}, high, {low.x(), high.y()}}, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
}

/// The metric of a stereographic chart of the unit sphere, for edges of length h.
Metric2 of_sphere(const Vec2& uv, double h) {
  const double k = 4 / (4 + dot(uv, uv)), m = k * k / (h * h);
  return {m, 0, m};
}

std::optional<ControlSpace> built(const SampledDomain& domain, const std::function<Metric2(Vec2)>& metric) {
  Monitor monitor;
  const MetricSampler sampler = [&](std::span<const Vec2> uv, std::span<Metric2> out) {
    for (std::size_t i = 0; i < uv.size(); ++i) out[i] = metric(uv[i]);
  };
  return build_even_space(domain, sampler, monitor);
}

double largest_error(const ControlSpace& space, double h) {
  double largest = 0;
  for (double x = -1.5; x <= 1.5; x += 0.09)
    for (double y = -1.5; y <= 1.5; y += 0.11)
      largest = std::max(largest, length_error(space.at({x, y}), of_sphere({x, y}, h)));
  return largest;
}

// Quadratic polynomials on cells as wide as edges: errors are of third order in the size.
TEST(EvenSpace, FollowsASphereInTheWholeBox) {
  double error[2];
  for (const int fine : {0, 1}) {
    const double h = fine == 0 ? 0.4 : 0.2;
    const auto space = built(disc(1.5, 40), [h](Vec2 uv) { return of_sphere(uv, h); });
    ASSERT_TRUE(space);
    error[fine] = largest_error(*space, h);
    // The disc of radius r is a cap of height z with area 2 pi z.
    const double cap = 2 * pi * 2 * 1.5 * 1.5 / (4 + 1.5 * 1.5);
    EXPECT_NEAR(space->measure(), cap / (std::numbers::sqrt3 / 4 * h * h), 0.03 * space->measure());
    EXPECT_LT(space->samples(), fine == 0 ? 200U : 600U);
  }
  EXPECT_LT(error[0], 0.5 * ControlSpaceOptions{}.tolerance);
  EXPECT_LT(error[1], error[0] / 6);
}

// A side on which the surface stands still: the metric of a cone's tip in polar parameters.
TEST(EvenSpace, IsDefiniteAtADegenerateSide) {
  const auto space = built(rectangle({0, 0}, {1, 2}), [](Vec2 uv) { return Metric2{uv.y() * uv.y() * 9, 0, 9}; });
  ASSERT_TRUE(space);
  for (int k = 0; k <= 40; ++k) {
    const Metric2 m = space->at({0.3, k * 0.05});
    EXPECT_GT(m.a, 0);
    EXPECT_GT(determinant(m), 0);
    EXPECT_NEAR(std::sqrt(m.a), 3 * k * 0.05, 0.02);
  }
}

TEST(EvenSpace, LargeBoxesHaveNone) {
  const auto unit = [](double h) { return [h](Vec2) { return Metric2{1 / (h * h), 0, 1 / (h * h)}; }; };
  EXPECT_TRUE(built(rectangle({0, 0}, {1, 1}), unit(0.1)));
  EXPECT_FALSE(built(rectangle({0, 0}, {1, 1}), unit(0.03)));
  EXPECT_FALSE(built(rectangle({0, 0}, {1, 0.01}), unit(0.01))) << "a strip";
  EXPECT_THROW(built(rectangle({0, 0}, {1, 0}), unit(1)), Error);
}

}  // namespace
}  // namespace carreau
