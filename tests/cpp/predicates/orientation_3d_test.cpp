// SPDX-License-Identifier: BSD-3-Clause
#include "predicates/orientation_3d.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <utility>

namespace carreau {
namespace {

using Integer = __int128;
using IntegerPoint = std::array<std::int64_t, 3>;

/// Coordinates below 2^38, so that products of three differences fit.
int integer_orientation(const std::array<IntegerPoint, 4>& p) {
  std::array<std::array<Integer, 3>, 3> d;
  for (int i = 0; i < 3; ++i)
    for (int x = 0; x < 3; ++x) d[i][x] = Integer(p[i + 1][x]) - p[0][x];
  const Integer volume = d[2][0] * (d[0][1] * d[1][2] - d[0][2] * d[1][1]) +
                         d[2][1] * (d[0][2] * d[1][0] - d[0][0] * d[1][2]) +
                         d[2][2] * (d[0][0] * d[1][1] - d[0][1] * d[1][0]);
  return (volume > 0) - (volume < 0);
}

Vec3 scaled(const IntegerPoint& p, int exponent) {
  return {std::ldexp(static_cast<double>(p[0]), exponent), std::ldexp(static_cast<double>(p[1]), exponent),
          std::ldexp(static_cast<double>(p[2]), exponent)};
}

TEST(Orientation3d, IsPositiveWhereTheTriangleIsCounterclockwise) {
  EXPECT_EQ(orientation(Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}), 1);
  EXPECT_EQ(orientation(Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, -1}), -1);
  EXPECT_EQ(orientation(Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{5, -3, 0}), 0);
}

TEST(Orientation3d, AgreesWithIntegersNearPlanesAtEveryScale) {
  std::mt19937_64 random(7);
  const auto integer = [&](int bits) {
    return static_cast<std::int64_t>(random() >> (64 - bits)) - (std::int64_t{1} << (bits - 1));
  };
  std::array<int, 3> seen{};
  for (int i = 0; i < 4000; ++i) {
    // d = a + k (b - a) + m (c - a), moved by at most one unit.
    std::array<IntegerPoint, 4> p;
    const std::int64_t k = integer(3), m = integer(3);
    for (int x = 0; x < 3; ++x) {
      for (int j = 0; j < 3; ++j) p[j][x] = integer(33);
      p[3][x] = p[0][x] + k * (p[1][x] - p[0][x]) + m * (p[2][x] - p[0][x]) + (i % 3 == 0 ? 0 : integer(2));
    }
    const int expected = integer_orientation(p);
    ++seen[expected + 1];
    for (const int exponent : {0, -30, -250, -600, -1074, 150, 460, 1023 - 40}) {
      const std::array<Vec3, 4> q{scaled(p[0], exponent), scaled(p[1], exponent), scaled(p[2], exponent),
                                  scaled(p[3], exponent)};
      ASSERT_EQ(orientation(q[0], q[1], q[2], q[3]), expected) << i << " at 2^" << exponent;
    }
  }
  for (const int n : seen) EXPECT_GT(n, 500);
}

TEST(Orientation3d, ChangesItsSignWithEachExchange) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int i = 0; i < 200; ++i) {
    // Points of a plane but for rounding: doubles alone would often contradict themselves.
    const Vec3 n{any(random), any(random), any(random)};
    std::array<Vec3, 4> p;
    for (Vec3& q : p) {
      const double x = any(random), y = any(random);
      q = {x, y, (1 - n.x() * x - n.y() * y) / n.z()};
    }
    const int sign = orientation(p[0], p[1], p[2], p[3]);
    std::array<int, 4> order{0, 1, 2, 3};
    do {
      int exchanges = 0;
      for (int a = 0; a < 4; ++a)
        for (int b = a + 1; b < 4; ++b) exchanges += order[a] > order[b] ? 1 : 0;
      ASSERT_EQ(orientation(p[order[0]], p[order[1]], p[order[2]], p[order[3]]), exchanges % 2 == 0 ? sign : -sign);
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

}  // namespace
}  // namespace carreau
