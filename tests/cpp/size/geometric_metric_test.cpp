// SPDX-License-Identifier: BSD-3-Clause
#include "size/geometric_metric.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/analytic_cad.h"
#include "cpp/cad/surfaces.h"
#include "metric/metric3_algebra.h"
#include "support/infinity.h"

namespace carreau {
namespace {

using namespace testing;
constexpr double pi = std::numbers::pi;
constexpr std::array criteria{GeometricCriterion::angle, GeometricCriterion::chord, GeometricCriterion::both,
                              GeometricCriterion::radii};

GeometricRule rule_of(GeometricCriterion criterion, bool anisotropic, double angle = 8, double eps0 = 0.01) {
  return {.criterion = criterion, .anisotropic = anisotropic, .angle_deg = angle, .eps0 = eps0};
}

// An edge of the size that the rule gives, on a circle: its sagitta is eps0, its angle with the tangent eps1.
TEST(GeometricSize, OnACircleTheCriterionIsMetExactly) {
  for (const double rho : {0.02, 1.0, 37.0}) {
    const double h0 = geometric_size(rule_of(GeometricCriterion::chord, false), rho);
    EXPECT_NEAR(rho - std::sqrt(rho * rho - h0 * h0 / 4), 0.01, 1e-11);
    const double h1 = geometric_size(rule_of(GeometricCriterion::angle, false), rho);
    EXPECT_NEAR(std::asin(h1 / (2 * rho)) * 180 / pi, 8, 1e-12);
    EXPECT_EQ(geometric_size(rule_of(GeometricCriterion::both, false), rho), std::min(h0, h1));
    EXPECT_EQ(geometric_size(rule_of(GeometricCriterion::radii, false), rho), h1);
  }
  // HDR eq. 2.31: a radius below eps0 counts as eps0.
  EXPECT_NEAR(geometric_size(rule_of(GeometricCriterion::chord, false), 1e-6), 0.02, 1e-15);
  for (const GeometricCriterion c : criteria) EXPECT_EQ(geometric_size(rule_of(c, false), infinity), infinity);
}

TEST(GeometricSizes, FiguresOfThePapers) {
  // HDR fig. 4.7: rho 1 and 4, eps0 0.7.
  auto h = geometric_sizes(rule_of(GeometricCriterion::chord, true, 8, 0.7), 1, 4);
  EXPECT_NEAR(h[0], 2 * std::sqrt(0.7 * 1.3), 1e-14);
  EXPECT_NEAR(h[1], 2 * std::sqrt(0.7 * 7.3), 1e-14);
  // HDR fig. 4.8: eps1 = 30 degrees, lambda = 1, second half axis sqrt((2 - sqrt 3)(14 + sqrt 3)) = 2.053.
  h = geometric_sizes(rule_of(GeometricCriterion::angle, true, 30), 1, 4);
  EXPECT_NEAR(h[0], 1, 1e-14);
  EXPECT_NEAR(h[1], std::sqrt((2 - std::sqrt(3)) * (14 + std::sqrt(3))), 1e-14);
  // RR-2928 eq. 41, 53 with eps = 1 - cos eps1: alpha = 2 sin eps1.
  h = geometric_sizes(rule_of(GeometricCriterion::radii, true, 30), 1, 4);
  const double eps = 1 - std::cos(pi / 6);
  EXPECT_NEAR(h[0], 2 * std::sqrt(eps * (2 - eps)), 1e-14);
  EXPECT_NEAR(h[1], 2 * std::sqrt(eps * (2 - eps)) * 4 * std::sqrt(1 - 0.75 * 0.75), 1e-14);
}

// The ellipse stays inside the curve of Euler's formula: no size exceeds the size by the radius of the normal section
// in its direction (HDR eq. 4.33, 4.39; RR-2928 eq. 42).
TEST(GeometricSizes, NoDirectionExceedsItsOwnRadius) {
  for (const double ratio : {1.0, 1.001, 4.0, 1e3, 1e6})
    for (const GeometricCriterion c : criteria) {
      const GeometricRule rule = rule_of(c, true, 20, 0.01);
      const double rho1 = 0.3, rho2 = ratio * rho1;
      const auto h = geometric_sizes(rule, rho1, rho2);
      for (int k = 0; k <= 200; ++k) {
        const double a = pi * k / 200, cosine = std::cos(a), sine = std::sin(a);
        const double size = 1 / std::hypot(cosine / h[0], sine / h[1]);
        const double rho = 1 / (cosine * cosine / rho1 + sine * sine / rho2);  // HDR eq. 4.27
        EXPECT_LE(size, geometric_size(rule, rho) * (1 + 1e-12));
      }
      EXPECT_LE(h[0], h[1]);
      EXPECT_GE(h[1], h[0] * (ratio > 1.1 ? 1.05 : 1));
    }
}

TEST(GeometricSizes, EqualRadiiAreIsotropicAndFlatOnesHaveNoBound) {
  for (const GeometricCriterion c : criteria) {
    const GeometricRule rule = rule_of(c, true);
    const auto h = geometric_sizes(rule, 2, 2);
    EXPECT_NEAR(h[1] / h[0], 1, 1e-12);
    EXPECT_EQ(geometric_sizes(rule, 1, infinity)[1], infinity);
    EXPECT_TRUE(std::isfinite(geometric_sizes(rule, 1, infinity)[0]));
    EXPECT_EQ(geometric_sizes(rule, infinity, infinity)[0], infinity);
    const auto far = geometric_sizes(rule, 1, 1e300);
    EXPECT_TRUE(std::isfinite(far[0]) && std::isfinite(far[1]));
    const auto isotropic = geometric_sizes(rule_of(c, false), 1, 5);
    EXPECT_EQ(isotropic[0], isotropic[1]);
  }
}

TEST(GeometricSizes, ScaleWithTheModel) {
  for (const GeometricCriterion c : criteria) {
    const auto h = geometric_sizes(rule_of(c, true, 8, 0.01), 1, 3);
    const auto large = geometric_sizes(rule_of(c, true, 8, 10), 1000, 3000);
    EXPECT_NEAR(large[0], 1000 * h[0], 1e-9);
    EXPECT_NEAR(large[1], 1000 * h[1], 1e-9);
  }
}

TEST(DirectedSizes, CylinderPlaneSphereAndPole) {
  for (const GeometricCriterion c : criteria) {
    const GeometricRule rule = rule_of(c, true);
    const auto cylinder = geometric_sizes(rule, cylinder_jet({0.4, 2}, 3));
    ASSERT_TRUE(cylinder);
    EXPECT_NEAR(cylinder->h1, geometric_size(rule, 3), 1e-12);
    EXPECT_EQ(cylinder->h2, infinity);
    EXPECT_NEAR(std::abs(cylinder->w2.z()), 1, 1e-12);
    EXPECT_NEAR(cylinder->w1.z(), 0, 1e-12);
    const auto plane = geometric_sizes(rule, SurfaceJet{{}, {1, 0, 0}, {1, 2, 0}, {}, {}, {}});
    ASSERT_TRUE(plane);
    EXPECT_EQ(plane->h1, infinity);
    const auto sphere = geometric_sizes(rule, sphere_jet({0.4, 0.7}, 2));
    ASSERT_TRUE(sphere);
    EXPECT_NEAR(sphere->h1, geometric_size(rule, 2), 1e-9);
    EXPECT_NEAR(sphere->h2, geometric_size(rule, 2), 1e-6);
    const auto flat_umbilic = geometric_sizes(rule, monkey_saddle_jet({0, 0}));
    ASSERT_TRUE(flat_umbilic);
    EXPECT_EQ(flat_umbilic->h1, infinity);
    const auto saddle = geometric_sizes(rule, enneper_jet({0.3, 0.2}));  // k1 = -k2
    ASSERT_TRUE(saddle);
    const double k = 2 / std::pow(1.13, 2);
    EXPECT_NEAR(saddle->h1, geometric_size(rule, 1 / k), 1e-9);
    EXPECT_NEAR(saddle->h2 / saddle->h1, 1, 1e-6);
    EXPECT_FALSE(geometric_sizes(rule, SurfaceJet{{}, {0, 0, 0}, {0, 1, 0}, {}, {}, {0, 0, 1}}));
  }
}

TEST(DirectedSizes, TorusAlongItsCirclesInAnyParametrisation) {
  const GeometricRule rule = rule_of(GeometricCriterion::chord, true);
  const double big = 4, small = 1, v = 0.5;
  const SurfaceJet jet = torus_jet({0.3, v}, big, small);
  const auto sizes = geometric_sizes(rule, jet);
  ASSERT_TRUE(sizes);
  const double rho2 = (big + small * std::cos(v)) / std::cos(v);
  EXPECT_NEAR(sizes->h1, geometric_size(rule, small), 1e-12);
  EXPECT_NEAR(sizes->h2, geometric_size(rule, rho2), 1e-10);
  EXPECT_NEAR(norm(cross(sizes->w1, jet.sv)) / norm(jet.sv), 0, 1e-12);
  EXPECT_NEAR(norm(cross(sizes->w2, jet.su)) / norm(jet.su), 0, 1e-12);
  // (u, v) = A (x, y): the same sizes and directions.
  const double a = 2, b = 0.7, c = -0.4, d = 1.5;
  SurfaceJet sheared = jet;
  sheared.su = a * jet.su + c * jet.sv;
  sheared.sv = b * jet.su + d * jet.sv;
  sheared.suu = a * a * jet.suu + 2 * a * c * jet.suv + c * c * jet.svv;
  sheared.suv = a * b * jet.suu + (a * d + b * c) * jet.suv + c * d * jet.svv;
  sheared.svv = b * b * jet.suu + 2 * b * d * jet.suv + d * d * jet.svv;
  const auto again = geometric_sizes(rule, sheared);
  ASSERT_TRUE(again);
  EXPECT_NEAR(again->h1, sizes->h1, 1e-10);
  EXPECT_NEAR(again->h2, sizes->h2, 1e-9);
  EXPECT_NEAR(std::abs(dot(again->w1, sizes->w1)), 1, 1e-10);
}

// The four umbilics of an ellipsoid a > b > c have the radius b^3 / (a c); around each the directions make half a turn.
TEST(DirectedSizes, UmbilicsOfAnEllipsoid) {
  const double a = 3, b = 2, c = 1;
  const auto face = half_ellipsoid(a, b, c).faces.at(1);
  const double x = std::sqrt((a * a - b * b) / (a * a - c * c)), z = std::sqrt((b * b - c * c) / (a * a - c * c));
  const Vec2 umbilic{x / (1 + z), 0};
  for (const GeometricCriterion criterion : criteria) {
    const GeometricRule rule = rule_of(criterion, true);
    const auto at = geometric_sizes(rule, face.at(umbilic));
    ASSERT_TRUE(at);
    EXPECT_NEAR(at->h1, geometric_size(rule, b * b * b / (a * c)), 1e-9);
    EXPECT_NEAR(at->h2 / at->h1, 1, 1e-6);
    double turned = 0;
    constexpr int steps = 64;
    std::optional<Vec3> last;
    for (int i = 0; i <= steps; ++i) {
      const double angle = 2 * pi * i / steps;
      const auto near = geometric_sizes(rule, face.at(umbilic + 0.01 * Vec2{std::cos(angle), std::sin(angle)}));
      ASSERT_TRUE(near);
      EXPECT_NEAR(near->h2 / near->h1, 1, 0.05);
      Vec3 w = near->w1;
      if (last) {
        if (dot(w, *last) < 0) w = -1.0 * w;
        turned += std::acos(std::min(1., dot(w, *last)));
      }
      last = w;
    }
    EXPECT_NEAR(turned, pi, 0.05);
  }
}

// At an inflection of a profile the curvature passes through zero: the size along it is not bounded by the surface
// there, the other one is.
TEST(DirectedSizes, Inflection) {
  // z = x^3 over a cylinder bent in y: z = x^3 + y^2 / 2 at x = 0.
  const SurfaceJet jet{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 1}};
  const auto sizes = geometric_sizes(rule_of(GeometricCriterion::angle, true), jet);
  ASSERT_TRUE(sizes);
  EXPECT_EQ(sizes->h2, infinity);
  EXPECT_NEAR(sizes->h1, 2 * std::sin(8 * pi / 180), 1e-14);
  EXPECT_NEAR(std::abs(sizes->w1.y()), 1, 1e-14);
}

}  // namespace
}  // namespace carreau
