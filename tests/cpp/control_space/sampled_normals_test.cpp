// SPDX-License-Identifier: BSD-3-Clause
#include "control_space/sampled_normals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace carreau {
namespace {

constexpr double degree = std::numbers::pi / 180;

Vec3 on_sphere(Vec2 angles) {
  return {std::cos(angles.x()) * std::cos(angles.y()), std::sin(angles.x()) * std::cos(angles.y()), std::sin(angles.y())};
}

/// Largest error, in degrees, on an octant of a sphere, but for the 10 degrees at its pole, that is sampled n times a
/// side and whose parameters are its angles times `scale`.
double error_of(int n, Vec2 scale) {
  const Vec2 top{90 * degree * scale.x(), 80 * degree * scale.y()};
  const auto angles = [scale](Vec2 uv) { return Vec2{uv.x() / scale.x(), uv.y() / scale.y()}; };
  const MetricSampler metric = [&](std::span<const Vec2> uv, std::span<Metric2> m) {
    for (std::size_t k = 0; k < uv.size(); ++k) {
      const double c = std::cos(angles(uv[k]).y()) / scale.x(), unit = 0.2;
      m[k] = {c * c / (unit * unit), 0, 1 / (scale.y() * scale.y() * unit * unit)};
    }
  };
  Monitor monitor;
  const SampledDomain domain{{{0, 0}, {top.x(), 0}, top, {0, top.y()}}, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
  const ControlSpace space = ControlSpace::build(domain, metric, {}, monitor);
  SampledNormals normals;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      const Vec2 uv{top.x() * i / n, top.y() * j / n};
      normals.add(uv, 7.0 * on_sphere(angles(uv)));
    }
  EXPECT_TRUE(normals.differ());
  normals.index(space);
  double largest = 0;
  constexpr int places = 57;
  for (int i = 0; i <= places; ++i)
    for (int j = 0; j <= places; ++j) {
      const Vec2 uv{top.x() * i / places, top.y() * j / places};
      const Vec3 found = normals.at(uv);
      EXPECT_NEAR(norm(found), 1, 1e-12);
      largest = std::max(largest, norm(found - on_sphere(angles(uv))) / degree);
    }
  return largest;
}

TEST(SampledNormals, ConvergeAtSecondOrder) {
  const double coarse = error_of(6, {1, 1}), middle = error_of(12, {1, 1}), fine = error_of(24, {1, 1});
  EXPECT_LT(coarse, 2);
  EXPECT_GT(std::log2(coarse / middle), 1.7);
  EXPECT_GT(std::log2(middle / fine), 1.7);
}

TEST(SampledNormals, DoNotDependOnTheScaleOfParameters) {
  EXPECT_NEAR(error_of(9, {1024, 1.0 / 64}), error_of(9, {1, 1}), 1e-3);
}

TEST(SampledNormals, AreExactAtSamples) {
  // A sampled line has no data across it: the mean of the values around.
  Monitor monitor;
  const SampledDomain square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
  const MetricSampler ten = [](std::span<const Vec2> uv, std::span<Metric2> m) {
    std::fill_n(m.begin(), uv.size(), Metric2{100, 0, 100});
  };
  const ControlSpace space = ControlSpace::build(square, ten, {}, monitor);
  SampledNormals line, area;
  for (int i = 0; i <= 8; ++i) {
    line.add({i / 8.0, 0.5}, on_sphere({i / 8.0, 0}));
    for (int j = 0; j <= 8; ++j) area.add({i / 8.0, j / 8.0}, on_sphere({i / 8.0, j / 8.0}));
  }
  line.index(space), area.index(space);
  for (int i = 0; i <= 8; ++i) {
    EXPECT_LT(norm(line.at({i / 8.0, 0.5}) - on_sphere({i / 8.0, 0})), 1e-3);
    EXPECT_LT(norm(area.at({i / 8.0, 0.25}) - on_sphere({i / 8.0, 0.25})), 1e-3);
  }
}

TEST(SampledNormals, DoNotDifferOnAPlane) {
  SampledNormals plane;
  plane.add({0, 0}, {});  // a pole
  for (int i = 1; i < 100; ++i) plane.add({0.1 * i, 0.2 * i}, {0.3 * i, 0.1 * i, -0.7 * i});
  EXPECT_FALSE(plane.differ());
  plane.add({0, 1}, {0.3, 0.1, -0.69});
  EXPECT_TRUE(plane.differ());
}

}  // namespace
}  // namespace carreau
