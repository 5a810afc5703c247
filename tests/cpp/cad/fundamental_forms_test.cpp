// SPDX-License-Identifier: BSD-3-Clause
#include "cad/fundamental_forms.h"

#include <gtest/gtest.h>

#include <limits>

#include "surfaces.h"

namespace carreau {
namespace {

using namespace testing;

void expect_near(Vec3 p, Vec3 q, double tolerance) { EXPECT_LE(norm(p - q), tolerance); }

// The equations that every frame must satisfy, whatever the surface (RR-2928 eq. 33-38).
void expect_consistent(const SurfaceJet& jet) {
  const auto frame = principal_frame(jet);
  const auto second = second_form(jet);
  ASSERT_TRUE(frame && second);
  const FirstForm first = first_form(jet);
  const double scale = 1e-12 * std::max(1.0, frame->largest());
  EXPECT_GE(frame->k1, frame->k2);
  EXPECT_NEAR(norm(frame->w1), 1, 1e-13);
  EXPECT_NEAR(norm(frame->w2), 1, 1e-13);
  expect_near(cross(frame->w1, frame->w2), frame->normal, 1e-13);
  expect_near(frame->x1.x() * jet.su + frame->x1.y() * jet.sv, frame->w1, 1e-12);
  expect_near(frame->x2.x() * jet.su + frame->x2.y() * jet.sv, frame->w2, 1e-12);
  EXPECT_NEAR(normal_curvature(first, *second, frame->x1), frame->k1, scale);
  EXPECT_NEAR(normal_curvature(first, *second, frame->x2), frame->k2, scale);
  // Eq. 36: principal directions are its roots.
  for (const Vec2& x : {frame->x1, frame->x2}) {
    const double root = (first.f * second->l - first.e * second->m) * x.x() * x.x() +
                        (first.g * second->l - first.e * second->n) * x.x() * x.y() +
                        (first.g * second->m - first.f * second->n) * x.y() * x.y();
    EXPECT_NEAR(root, 0, scale * std::sqrt(first.e * first.g - first.f * first.f));
  }
  // Gauss and mean curvature by their usual quotients.
  const double det = first.e * first.g - first.f * first.f;
  EXPECT_NEAR(frame->k1 * frame->k2, (second->l * second->n - second->m * second->m) / det, scale * frame->largest());
  EXPECT_NEAR(frame->mean(), (first.e * second->n - 2 * first.f * second->m + first.g * second->l) / (2 * det), scale);
}

TEST(PrincipalFrame, ObeysTheDefinitionsOnEverySurface) {
  for (double u = -1.3; u < 1.5; u += 0.37)
    for (double v = -1.2; v < 1.3; v += 0.41) {
      const Vec2 p{u, v};
      expect_consistent(paraboloid_jet(p));
      expect_consistent(cylinder_jet(p, 0.3));
      expect_consistent(torus_jet(p, 2, 0.7));
      expect_consistent(enneper_jet(p));
      expect_consistent(monkey_saddle_jet(p));
    }
}

TEST(PrincipalFrame, PlanesHaveZeroCurvatureInAnyParametrisation) {
  const SurfaceJet sheared{{}, {1e-3, 0, 0}, {700, 1e3, 0}, {}, {}, {}};
  const auto frame = principal_frame(sheared);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->k1, 0);
  EXPECT_EQ(frame->k2, 0);
  expect_near(frame->normal, {0, 0, 1}, 1e-15);
  expect_near(frame->w1, {1, 0, 0}, 1e-15);
}

TEST(PrincipalFrame, SpheresAreUmbilicWithoutLossOfDigits) {
  // A cancellation in H^2 - K would leave 1e-8 here.
  for (const double v : {-1.5, -0.3, 0.0, 0.7, 1.57}) {
    const auto frame = principal_frame(sphere_jet({0.4, v}, 2.5));
    ASSERT_TRUE(frame);
    EXPECT_NEAR(frame->k1, -1 / 2.5, 1e-13);
    EXPECT_NEAR(frame->k2, -1 / 2.5, 1e-13);
  }
}

TEST(PrincipalFrame, CylindersFollowAxisAndCircle) {
  const auto frame = principal_frame(cylinder_jet({0.9, 0.2}, 4));
  ASSERT_TRUE(frame);
  EXPECT_NEAR(frame->k1, 0, 1e-15);
  EXPECT_NEAR(frame->k2, -0.25, 1e-15);  // outward normal
  EXPECT_NEAR(std::abs(frame->w1.z()), 1, 1e-15);
  EXPECT_NEAR(frame->largest(), 0.25, 1e-15);
}

TEST(PrincipalFrame, TorusMatchesTheClosedForm) {
  const double big = 3, small = 1;
  for (const double v : {0.0, 0.5, 1.6, 3.0, 4.4}) {
    const auto frame = principal_frame(torus_jet({0.3, v}, big, small));
    ASSERT_TRUE(frame);
    const double around = -std::cos(v) / (big + small * std::cos(v)), tube = -1 / small;  // outward normal
    EXPECT_NEAR(frame->k1, std::max(around, tube), 1e-13);
    EXPECT_NEAR(frame->k2, std::min(around, tube), 1e-13);
  }
}

TEST(PrincipalFrame, ParaboloidMatchesTheClosedForm) {
  for (const double r : {0.0, 0.1, 1.0, 2.5}) {
    const auto frame = principal_frame(paraboloid_jet({0.6 * r, 0.8 * r}));
    ASSERT_TRUE(frame);
    EXPECT_NEAR(frame->k1, 1 / std::sqrt(1 + r * r), 1e-14);
    EXPECT_NEAR(frame->k2, std::pow(1 + r * r, -1.5), 1e-14);
  }
}

TEST(PrincipalFrame, EnnepersSurfaceIsMinimal) {
  for (const Vec2& p : {Vec2{0, 0}, Vec2{0.7, -0.2}, Vec2{-2, 1}}) {
    const auto frame = principal_frame(enneper_jet(p));
    ASSERT_TRUE(frame);
    const double k = 2 / std::pow(1 + dot(p, p), 2);
    EXPECT_NEAR(frame->k1, k, 1e-13);
    EXPECT_NEAR(frame->k2, -k, 1e-13);
  }
}

TEST(PrincipalFrame, TheMonkeySaddleIsFlatAtItsCentre) {
  const auto frame = principal_frame(monkey_saddle_jet({0, 0}));
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->largest(), 0);
  const Vec2 p{0.3, -0.4};
  const double r2 = dot(p, p);
  const auto beside = principal_frame(monkey_saddle_jet(p));
  ASSERT_TRUE(beside);
  EXPECT_NEAR(beside->k1 * beside->k2, -36 * r2 / std::pow(1 + 9 * r2 * r2, 2), 1e-12);
}

TEST(PrincipalFrame, DoesNotDependOnTheScaleOfParameters) {
  // S(a u, b v) has the same shape.
  const double a = 1e-5, b = 1e4;
  const SurfaceJet j = torus_jet({0.4, 1.1}, 2, 0.5);
  const SurfaceJet scaled{j.s, a * j.su, b * j.sv, (a * a) * j.suu, (a * b) * j.suv, (b * b) * j.svv};
  const auto frame = principal_frame(j), same = principal_frame(scaled);
  ASSERT_TRUE(frame && same);
  EXPECT_NEAR(frame->k1, same->k1, 1e-13);
  EXPECT_NEAR(frame->k2, same->k2, 1e-13);
  expect_near(frame->w2, same->w2, 1e-12);
}

TEST(PrincipalFrame, IsEmptyWhereTheParametrisationIsDegenerate) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(unit_normal(sphere_jet({0.3, std::acos(-1.0) / 2}, 1)));  // the pole, where rounding leaves 6e-17
  EXPECT_FALSE(principal_frame(SurfaceJet{}));
  EXPECT_FALSE(unit_normal(SurfaceJet{{}, {1, 2, 3}, {2, 4, 6}, {}, {}, {}}));
  EXPECT_FALSE(unit_normal(SurfaceJet{{}, {nan, 0, 0}, {0, 1, 0}, {}, {}, {}}));
  EXPECT_FALSE(unit_normal(SurfaceJet{{}, {1e200, 0, 0}, {0, 1e200, 0}, {}, {}, {}}));
  EXPECT_FALSE(principal_frame(SurfaceJet{{}, {1, 0, 0}, {0, 1, 0}, {}, {}, {0, 0, nan}}));
}

}  // namespace
}  // namespace carreau
