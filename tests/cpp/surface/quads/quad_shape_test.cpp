// SPDX-License-Identifier: BSD-3-Clause
// Shapes in closed form (HDR sec. 1.1.1).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "mesh/surface_mesh.h"
#include "surface/elements/quads/quad_shape.h"

namespace carreau {
namespace {

using Quad = std::array<Vec2, 4>;

Quad rhombus(double degrees) {
  const double a = degrees * std::numbers::pi / 180;
  const Vec2 e{1, 0}, f{std::cos(a), std::sin(a)};
  return {Vec2{0, 0}, e, Vec2(e + f), f};
}

std::array<Vec3, 4> placed(const Quad& q, const Vec3& e, const Vec3& f) {
  std::array<Vec3, 4> p;
  for (int k = 0; k < 4; ++k) p[k] = Vec3{1, 2, 3} + q[k].x() * e + q[k].y() * f;
  return p;
}

TEST(QuadShape, SquareIsOneHoweverItLies) {
  const double c = std::cos(0.3), s = std::sin(0.3);
  const Quad q{Vec2{5, 7}, Vec2{5 + 2 * c, 7 + 2 * s}, Vec2{5 + 2 * (c - s), 7 + 2 * (c + s)}, Vec2{5 - 2 * s, 7 + 2 * c}};
  EXPECT_NEAR(quad_quality(q), 1, 1e-14);
  EXPECT_NEAR(scaled_jacobian(q), 1, 1e-14);
}

// Diameter: the long diagonal 2 cos 30; the triangle with the angle of 120 degrees has the least circle.
TEST(QuadShape, RhombusOfSixtyDegrees) {
  const double root3 = std::numbers::sqrt3, rho = (root3 / 2) / (2 + root3), sigma = root3 / rho;
  EXPECT_NEAR(quad_quality(rhombus(60)), (2 + 2 * std::numbers::sqrt2) / sigma, 1e-14);
  EXPECT_NEAR(scaled_jacobian(rhombus(60)), root3 / 2, 1e-14);
}

// h = sqrt(1 + r^2), rho = r / (1 + r + h).
TEST(QuadShape, Rectangles) {
  for (const double r : {0.1, 0.5, 1., 3.}) {
    const Quad q{Vec2{0, 0}, Vec2{1, 0}, Vec2{1, r}, Vec2{0, r}};
    const double h = std::sqrt(1 + r * r);
    EXPECT_NEAR(quad_quality(q), (2 + 2 * std::numbers::sqrt2) * r / (1 + r + h) / h, 1e-14);
    EXPECT_NEAR(scaled_jacobian(q), 1, 1e-14);
  }
}

TEST(QuadShape, NonConvexQuadrilateralsHaveNoQuality) {
  const Quad dart{Vec2{0, 0}, Vec2{2, 0}, Vec2{0.5, 0.5}, Vec2{0, 2}}, crossed{Vec2{0, 0}, Vec2{1, 1}, Vec2{1, 0}, Vec2{0, 1}};
  EXPECT_EQ(quad_quality(dart), 0);
  EXPECT_LT(scaled_jacobian(dart), 0);
  EXPECT_EQ(quad_quality(crossed), 0);
  const Quad clockwise{Vec2{0, 0}, Vec2{0, 1}, Vec2{1, 1}, Vec2{1, 0}};
  EXPECT_EQ(quad_quality(clockwise), 0);
}

TEST(QuadShape, IsTheSameInAnyPlaneOfSpace) {
  const Vec3 e{2. / 3, 2. / 3, 1. / 3}, f{-2. / 3, 1. / 3, 2. / 3};
  for (const double a : {30., 75., 90., 140.}) {
    EXPECT_NEAR(quad_quality(placed(rhombus(a), e, f)), quad_quality(rhombus(a)), 1e-13) << a;
    EXPECT_NEAR(scaled_jacobian(placed(rhombus(a), e, f)), scaled_jacobian(rhombus(a)), 1e-13) << a;
  }
}

TEST(QuadShape, InAMetricThatStretchesASquareIsARectangle) {
  const ControlSpace space = ControlSpace::constant({25, 0, 1});  // ratio 5
  const QuadPatch patch{{{0, 0}, {0.2, 0}, {0.2, 1}, {0, 1}}, {1, 1, 1, 1}, {{0, 1, 2, 3}}};
  EXPECT_NEAR(cell_quality(patch, FaceCharts(space), patch.cells[0]), 1, 1e-12);
  EXPECT_TRUE(is_convex(patch, patch.cells[0]));
  EXPECT_FALSE(is_convex(patch, {0, 3, 2, 1}));
  EXPECT_FALSE(is_convex(patch, {0, 2, 1, 3}));
}

TEST(QuadShape, FlatCornersMatchTheList) {
  QuadPatch patch;
  patch.uv = {{0, 0}, {1, 0}, {2, 0.1}, {1, 1}};
  patch.fixed = {1, 1, 1, 0};
  const MixedCell cell{0, 1, 2, 3}, triangle{0, 1, 2, -1};
  EXPECT_FALSE(has_flat_corner(patch, cell));
  patch.flat = {{1, 0, 2}, {1, 2, 0}};
  EXPECT_TRUE(has_flat_corner(patch, cell));
  EXPECT_TRUE(has_flat_corner(patch, {2, 3, 0, 1}));
  EXPECT_TRUE(has_flat_corner(patch, triangle));
  EXPECT_FALSE(has_flat_corner(patch, {0, 1, 3, -1}));
}

// At a pole two quadrilaterals may meet in two edges, and their better halves be one triangle.
TEST(QuadShape, HalvesAtAPoleDiffer) {
  FaceMesh face;
  const std::vector<Vec3> vertices{{0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {0, 2, -1}, {0, -2, -1}};
  face.uv = {{0, 0}, {1, 0}, {-1, 0}, {0, 2}, {0, -2}};
  face.vertex = {0, 1, 2, 3, 4};
  face.flattened = {{0, 0, 1}};
  const std::vector<std::array<std::int32_t, 4>> quads{{1, 3, 2, 0}, {2, 4, 1, 0}};
  set_cells(face, quads, {}, vertices);
  std::set<std::array<std::int32_t, 3>> met;
  for (std::array<std::int32_t, 3> t : face.triangles) {
    std::sort(t.begin(), t.end());
    met.insert(t);
  }
  EXPECT_EQ(met.size(), 4U);
  ASSERT_EQ(face.quads, 2);
  for (int q = 0; q < 2; ++q) {
    std::array<std::int32_t, 4> now = face.quad(static_cast<std::size_t>(q)), given = quads[static_cast<std::size_t>(q)];
    std::sort(now.begin(), now.end()), std::sort(given.begin(), given.end());
    EXPECT_EQ(now, given);
  }
}

}  // namespace
}  // namespace carreau
