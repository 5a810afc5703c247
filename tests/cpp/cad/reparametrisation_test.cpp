// SPDX-License-Identifier: BSD-3-Clause
#include "cad/reparametrisation.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "surfaces.h"

namespace carreau {
namespace {

using namespace testing;

// Widths of a million to one.
MonotoneMap uneven() { return {{0, 0.4, 0.5, 0.9, 2}, {-1, -0.3, -0.299999, 0.5, 4}}; }

TEST(MonotoneMap, IncreasesThroughItsPointsAndBack) {
  const MonotoneMap map = uneven();
  EXPECT_EQ(map(0), -1);
  EXPECT_EQ(map(2), 4);
  EXPECT_EQ(map(-1), -1);
  EXPECT_EQ(map(3), 4);
  EXPECT_NEAR(map(0.5), -0.299999, 1e-15);
  double before = -2;
  for (int k = 0; k <= 1000; ++k) {
    const double x = 2 * k / 1000., u = map(x);
    EXPECT_GT(u, before) << x;
    before = u;
    EXPECT_NEAR(map(map.inverse(u)), u, 4e-16 * std::max(std::abs(u), 1.)) << x;
    EXPECT_NEAR(map.inverse(u), x, 1e-8) << x;
  }
  EXPECT_EQ(map.inverse(-1), 0);
  EXPECT_EQ(map.inverse(4), 2);
  EXPECT_EQ(map.inverse(-7), 0);
}

TEST(MonotoneMap, DerivativesAreThose) {
  const MonotoneMap map = uneven();
  for (const double x : {0.1, 0.3, 0.45, 0.6, 0.8, 1.3, 1.9}) {
    const double h = 1e-4, u = map.jet(x).first;
    EXPECT_NEAR(map.jet(x).first, (map(x + h) - map(x - h)) / (2 * h), 1e-6 * (1 + u)) << x;
    EXPECT_NEAR(map.jet(x).second, (map.jet(x + h).first - map.jet(x - h).first) / (2 * h), 1e-6) << x;
    EXPECT_GT(u, 0) << x;
  }
}

TEST(MonotoneMap, ALineStaysOne) {
  const MonotoneMap map({0, 1, 3}, {5, 7, 11});
  for (const double x : {0., 0.3, 1., 2.2, 3.}) {
    EXPECT_NEAR(map(x), 5 + 2 * x, 1e-14);
    EXPECT_NEAR(map.jet(x).first, 2, 1e-14);
    EXPECT_NEAR(map.jet(x).second, 0, 1e-13);
  }
}

TEST(MonotoneMap, MustIncrease) {
  EXPECT_THROW(MonotoneMap({0, 1}, {1, 1}), InvalidArgument);
  EXPECT_THROW(MonotoneMap({0, 0, 1}, {0, 1, 2}), InvalidArgument);
  EXPECT_THROW(MonotoneMap({0}, {0}), InvalidArgument);
  EXPECT_THROW(MonotoneMap({0, 1}, {0, 1, 2}), InvalidArgument);
}

// x = a, y = b: derivatives by (x, y) are derivatives by (u, v) of the same surface at other parameters.
TEST(Reparametrised, ObeysTheChainRule) {
  AnalyticCad cad;
  cad.faces[1].at = [](Vec2 p) { return torus_jet(p, 2, 0.7); };
  cad.faces[2].at = paraboloid_jet;
  const Reparametrisation map{uneven(), {{0, 1, 2}, {0, 0.2, 3}}};
  const auto even = reparametrised(cad, 1, map);
  const unsigned all = want_position | want_first | want_second;
  for (const Vec2& p : {Vec2{0.2, 0.3}, {0.45, 0.7}, {0.7, 1.5}, {1.6, 1.9}}) {
    const SurfaceJet jet = surface_at(*even, 1, all, p);
    EXPECT_EQ(jet.s, surface_at(cad, 1, all, map.to_host(p)).s);
    const auto beside = [&](double x, double y) { return surface_at(*even, 1, all, {p.x() + x, p.y() + y}); };
    constexpr double h = 1e-5;
    const auto expect_near = [](Vec3 a, Vec3 b) { EXPECT_LT(norm(a - b), 1e-6 * (1 + norm(a))); };
    expect_near(jet.su, (1 / (2 * h)) * (beside(h, 0).s - beside(-h, 0).s));
    expect_near(jet.sv, (1 / (2 * h)) * (beside(0, h).s - beside(0, -h).s));
    expect_near(jet.suu, (1 / (2 * h)) * (beside(h, 0).su - beside(-h, 0).su));
    expect_near(jet.suv, (1 / (2 * h)) * (beside(0, h).su - beside(0, -h).su));
    expect_near(jet.svv, (1 / (2 * h)) * (beside(0, h).sv - beside(0, -h).sv));
  }
  EXPECT_EQ(surface_at(*even, 2, all, {0.2, 0.3}).s, paraboloid_jet({0.2, 0.3}).s);
}

}  // namespace
}  // namespace carreau
