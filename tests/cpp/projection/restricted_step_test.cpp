// SPDX-License-Identifier: BSD-3-Clause
#include "projection/restricted_step.h"

#include <gtest/gtest.h>

namespace carreau::projection {
namespace {

const Region unit{{0, 0}, {1, 1}};
const Region half{{0, 0}, {1, 1}, true};
const Symmetric2 identity{1, 0, 1};

TEST(RestrictedStep, MinimumOfAQuadraticInside) {
  // f = (u - .3)^2 + (u - .3)(v - .6) + (v - .6)^2 at (.8, .1)
  const Symmetric2 h{2, 1, 2};
  const Vec2 p{0.8, 0.1}, g = h.times(p - Vec2(0.3, 0.6));
  const RestrictedStep step = restricted_step(unit, p, g, h, identity);
  EXPECT_TRUE(step.full);
  EXPECT_NEAR(norm(step.to - Vec2(0.3, 0.6)), 0, 1e-15);
  EXPECT_NEAR(step.gain, 0.5 * dot(p - Vec2(0.3, 0.6), g), 1e-15);
}

TEST(RestrictedStep, ReachesTheConstrainedMinimumOfABoxAndATriangle) {
  for (const Region& region : {unit, half})
    for (const Vec2& target : {Vec2(1.5, 0.25), Vec2(-0.5, 0.5), Vec2(2, 2), Vec2(-1, -1), Vec2(0.5, -1), Vec2(0.9, 0.4)}) {
      const Symmetric2 h{2, 0.6, 1};
      const auto value = [&](const Vec2& p) { return 0.5 * dot(p - target, h.times(p - target)); };
      Vec2 p{0.2, 0.3};
      for (int k = 0; k < 20; ++k) {
        const RestrictedStep step = restricted_step(region, p, h.times(p - target), h, identity);
        EXPECT_LE(value(step.to), value(p) + 1e-15);
        p = step.to;
      }
      double least = 1e300;
      for (int i = 0; i <= 1000; ++i)
        for (int j = 0; j <= 1000; ++j)
          if (!region.triangle || i + j <= 1000) least = std::min(least, value({i / 1000.0, j / 1000.0}));
      EXPECT_LE(value(p), least + 1e-12) << target.transpose() << " " << region.triangle;
    }
}

TEST(RestrictedStep, DescendsWhereTheHessianIsIndefinite) {
  const RestrictedStep step = restricted_step(unit, {0.5, 0.5}, {0.1, 0.1}, {1, 0, -1}, identity);
  EXPECT_FALSE(step.full);
  EXPECT_LT(dot(step.d, Vec2(0.1, 0.1)), 0);
}

TEST(RestrictedStep, FollowsAWallThatRoundingPointsOutOf) {
  for (const Region& region : {unit, half}) {
    const RestrictedStep step = restricted_step(region, {0, 0.5}, {1e-17, 0.32}, identity, identity);
    EXPECT_EQ(step.to.x(), 0);
    EXPECT_NEAR(step.to.y(), 0.18, 1e-15);
  }
  const RestrictedStep diagonal = restricted_step(half, {0.5, 0.5}, {0.25 - 1e-17, -0.25 - 1e-17}, identity, identity);
  EXPECT_NEAR(norm(diagonal.to - Vec2(0.25, 0.75)), 0, 1e-14);
}

TEST(RestrictedStep, RestsAtACornerThatHoldsTheMinimum) {
  const RestrictedStep step = restricted_step(unit, {1, 1}, {-1, -2}, identity, identity);
  EXPECT_EQ(norm(step.d), 0);
}

}  // namespace
}  // namespace carreau::projection
