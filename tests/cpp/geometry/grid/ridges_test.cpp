// SPDX-License-Identifier: BSD-3-Clause
// Ridges of surfaces whose lines of extremal curvature are closed forms.
#include "geometry/grid/ridges/ridges.h"

#include <gtest/gtest.h>

#include "geometry/grid/grid_cad.h"
#include "grid_test_support.h"

namespace carreau::grid {
namespace {

std::vector<std::vector<Vec3>> ridges_of(Block block, double radius, const Options& options = {}) {
  Monitor silent;
  const GridGeometry made = build({std::move(block)}, options);
  return find_ridges(*dynamic_cast<const GridCad&>(*made.built.cad).surfaces().at(0), radius, silent);
}

double length_of(const std::vector<Vec3>& line) {
  double sum = 0;
  for (std::size_t k = 1; k < line.size(); ++k) sum += norm(line[k] - line[k - 1]);
  return sum;
}

/// Half of the elliptic cylinder (2 cos t, y, sin t), with lines of constant t that are oblique in the grid. Its curvature is 2 at (2, y, 0).
Block elliptic_cylinder(int n) {
  return block_of(2 * n + 1, n + 1, [n](int i, int j) -> Vec3 {
    const double y = 2.0 * j / n, t = -1.3 + 2.6 * i / (2 * n) + 0.17 * std::sin(y) + 0.031;
    return {2 * std::cos(t), y, std::sin(t)};
  });
}

TEST(Ridges, OfAnEllipticCylinderAreItsSharpRulings) {
  double before = 0;
  for (const int n : {12, 24, 48}) {
    const auto lines = ridges_of(elliptic_cylinder(n), 0.55);
    ASSERT_EQ(lines.size(), 1u) << n;
    EXPECT_NEAR(length_of(lines[0]), 2, 0.02);
    double error = 0;
    for (const Vec3& p : lines[0]) error = std::max(error, std::hypot(p.x() - 2, p.z()));
    if (before > 0) {
      EXPECT_GT(std::log2(before / error), 1.7) << n;
    }
    before = error;
  }
  EXPECT_LT(before, 2e-5);
  EXPECT_TRUE(ridges_of(elliptic_cylinder(24), 0.45).empty());  // the radius is .5 there
}

TEST(Ridges, OfARoundedRoofAreItsTop) {
  // z = -sqrt(x^2 + c^2): radius c at x = 0, where no node lies. Turned by 25 degrees against the grid.
  constexpr double c = 0.3, turn = 25 * std::numbers::pi / 180;
  const Block roof = block_of(41, 41, [](int i, int j) -> Vec3 {
    const double p = -1 + i / 20.0, q = -1 + j / 20.0, x = std::cos(turn) * p + std::sin(turn) * q + 0.013;
    return {p, q, -std::sqrt(x * x + c * c)};
  });
  for (const bool splines : {false, true}) {
    const auto lines = ridges_of(roof, 1.2 * c, {.splines = splines});
    ASSERT_EQ(lines.size(), 1u);
    for (const Vec3& p : lines[0]) EXPECT_NEAR(std::cos(turn) * p.x() + std::sin(turn) * p.y() + 0.013, 0, 2e-3);
    EXPECT_NEAR(length_of(lines[0]), 2 / std::cos(turn), 0.01);  // from border to border
  }
  EXPECT_TRUE(ridges_of(roof, 0.9 * c).empty());
}

TEST(Ridges, OfASpheroidAreItsEquator) {
  // Axes 2, 2, 1: curvature 2 along meridians at the equator. 25 intervals from pole to pole: it lies between two rows.
  Block spheroid = globe(48, 25, [](double, double) { return 1.0; });
  for (Vec3& p : spheroid.nodes) p = {2 * p.x(), 2 * p.y(), p.z()};
  const auto lines = ridges_of(spheroid, 0.6);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NEAR(length_of(lines[0]), 4 * std::numbers::pi, 0.02);
  EXPECT_LE(norm(lines[0].front() - lines[0].back()), 1e-9);
  for (const Vec3& p : lines[0]) EXPECT_NEAR(p.z(), 0, 1e-3);
  // A prolate one has its two sharp ends, and no line.
  Block prolate = globe(48, 25, [](double, double) { return 1.0; });
  for (Vec3& p : prolate.nodes) p.z() *= 2;
  EXPECT_TRUE(ridges_of(prolate, 1.0).empty());
}

TEST(Ridges, OfARingAreClosedLinesWithoutZigzag) {
  // z = exp(-((r - 1) / w)^2): its top has radius w^2 / 2 across.
  constexpr double w = 0.5;
  const Block ring = block_of(61, 61, [](int i, int j) -> Vec3 {
    const double x = -2 + i / 15.0 + 0.01, y = -2 + j / 15.0 - 0.02, d = (std::hypot(x, y) - 1) / w;
    return {x, y, std::exp(-d * d)};
  });
  const auto lines = ridges_of(ring, 0.15);
  ASSERT_EQ(lines.size(), 1u);
  const std::vector<Vec3>& line = lines[0];
  EXPECT_EQ(line.front(), line.back());
  EXPECT_NEAR(length_of(line), 2 * std::numbers::pi, 0.01);
  for (const Vec3& p : line) EXPECT_NEAR(std::hypot(p.x(), p.y()), 1, 5e-3);
  for (std::size_t k = 2; k < line.size(); ++k) {
    const Vec3 a = line[k - 1] - line[k - 2], b = line[k] - line[k - 1];
    EXPECT_LT(std::atan2(norm(cross(a, b)), dot(a, b)), 15 * std::numbers::pi / 180);  // corners of embedded lines turn by more
  }
}

TEST(Ridges, CirclesHaveNone) {
  const auto cylinder = block_of(33, 9, [](int i, int j) -> Vec3 { return {std::cos(0.09 * i), std::sin(0.09 * i), 0.3 * j}; });
  EXPECT_TRUE(ridges_of(cylinder, 2).empty());
  EXPECT_TRUE(ridges_of(sphere(40, 21), 2).empty());
  const auto flat = block_of(5, 5, [](int i, int j) -> Vec3 { return {double(i), double(j), 0}; });
  EXPECT_TRUE(ridges_of(flat, 100).empty());
}

TEST(Ridges, OnTheBorderAreTheBorder) {
  for (const double start : {0.0, 1e-6, -1e-6, -1e-3}) {
    const Block block = block_of(20, 12, [start](int i, int j) -> Vec3 {
      const double t = start + 1.3 * i / 19;
      return {2 * std::cos(t), j / 6.0, std::sin(t)};
    });
    EXPECT_TRUE(ridges_of(block, 0.6).empty()) << start;
  }
}

TEST(Ridges, EndAtMissingNodes) {
  Block block = elliptic_cylinder(24);
  for (int j = 10; j < 14; ++j)
    for (int i = 20; i < 30; ++i) block.nodes[block.index(i, j)].setConstant(std::nan(""));
  const auto lines = ridges_of(block, 0.55);
  double length = 0;
  for (const auto& line : lines) {
    length += length_of(line);
    for (const Vec3& p : line) EXPECT_LT(std::hypot(p.x() - 2, p.z()), 5e-3);
  }
  EXPECT_EQ(lines.size(), 2u);
  EXPECT_NEAR(length, 2 - 5 * 2 / 24.0, 0.25);
}

}  // namespace
}  // namespace carreau::grid
