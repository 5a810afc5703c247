// SPDX-License-Identifier: BSD-3-Clause
#include "predicates/predicates.h"

#include "predicates/convex_quad.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace carreau {
namespace {

using Integer = __int128;

int sign(Integer value) { return (value > 0) - (value < 0); }

/// Coordinates are integers below 2^60 (orientation) or 2^28 (in_circle), so the products fit 127 bits.
int integer_orientation(const std::array<std::array<std::int64_t, 2>, 3>& p) {
  const Integer ax = p[0][0] - p[2][0], ay = p[0][1] - p[2][1];
  const Integer bx = p[1][0] - p[2][0], by = p[1][1] - p[2][1];
  return sign(ax * by - ay * bx);
}

int integer_in_circle(const std::array<std::array<std::int64_t, 2>, 4>& p) {
  Integer x[3], y[3], s[3];
  for (int i = 0; i < 3; ++i) {
    x[i] = p[i][0] - p[3][0];
    y[i] = p[i][1] - p[3][1];
    s[i] = x[i] * x[i] + y[i] * y[i];
  }
  return sign((x[1] * y[2] - x[2] * y[1]) * s[0] + (x[2] * y[0] - x[0] * y[2]) * s[1] +
              (x[0] * y[1] - x[1] * y[0]) * s[2]);
}

template <std::size_t N>
std::array<Vec2, N> scaled(const std::array<std::array<std::int64_t, 2>, N>& p, int exponent) {
  std::array<Vec2, N> q;
  for (std::size_t i = 0; i < N; ++i)
    q[i] = {std::ldexp(static_cast<double>(p[i][0]), exponent), std::ldexp(static_cast<double>(p[i][1]), exponent)};
  return q;
}

int orientation_of(const std::array<Vec2, 3>& p) { return orientation(p[0], p[1], p[2]); }
int in_circle_of(const std::array<Vec2, 4>& p) { return in_circle(p[0], p[1], p[2], p[3]); }

/// Powers of two that keep integers of `bits` bits finite and exact: the whole range of doubles.
std::vector<int> exponents(int bits) { return {0, -30, -250, -600, -1074, 150, 460, 1023 - bits}; }

TEST(Orientation, AgreesWithIntegersNearCollinearAtEveryScale) {
  std::mt19937_64 random(1);
  const auto integer = [&](int bits) {
    return static_cast<std::int64_t>(random() >> (64 - bits)) - (std::int64_t{1} << (bits - 1));
  };
  std::array<int, 3> seen{};
  for (int i = 0; i < 4000; ++i) {
    // c = a + k (b - a) / m, moved by a few units: collinear, or off by less than doubles resolve.
    std::array<std::array<std::int64_t, 2>, 3> p;
    const std::int64_t m = 1 + (i % 5), dx = integer(45), dy = integer(45);
    p[0] = {integer(50), integer(50)};
    p[1] = {p[0][0] + m * dx, p[0][1] + m * dy};
    p[2] = {p[0][0] + 3 * dx + i % 3 - 1, p[0][1] + 3 * dy + i / 3 % 3 - 1};
    const int expected = integer_orientation(p);
    ++seen[static_cast<std::size_t>(expected + 1)];
    for (const int e : exponents(52)) ASSERT_EQ(orientation_of(scaled(p, e)), expected) << i << " scale 2^" << e;
  }
  for (const int count : seen) EXPECT_GT(count, 300);
}

TEST(Orientation, IsExactWhenDifferencesRound) {
  // 53-bit mantissas at different exponents: a.x - c.x has up to 70 bits. Reference: 2^-30 units in __int128.
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto units = [](double x) { return static_cast<Integer>(std::ldexp(x, 60)); };
  int zeros = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto coordinate = [&](int bits) { return std::ldexp(std::floor(std::ldexp(unit(random), bits)), -60); };
    const Vec2 a{coordinate(20), coordinate(20)};
    const Vec2 b{coordinate(60), coordinate(60)};
    Vec2 c{0.5 * b.x(), 0.5 * b.y()};
    if (i % 2 == 0) c = {std::nextafter(c.x(), 1), c.y()};
    c = {std::ldexp(std::floor(std::ldexp(c.x(), 60)), -60), std::ldexp(std::floor(std::ldexp(c.y(), 60)), -60)};
    const Integer ax = units(a.x()) - units(c.x()), ay = units(a.y()) - units(c.y());
    const Integer bx = units(b.x()) - units(c.x()), by = units(b.y()) - units(c.y());
    const int expected = sign(ax * by - ay * bx);
    zeros += expected == 0;
    ASSERT_EQ(orientation(a, b, c), expected) << i;
    ASSERT_EQ(detail::exact_orientation(a, b, c), expected) << i;
  }
  EXPECT_LT(zeros, 20000);
}

TEST(Orientation, KettnerGridHasAStraightZeroLine) {
  // Kettner et al., "Classroom examples of robustness problems" (2008), fig. 2: 256 x 256 points one ulp apart
  // near (0.5, 0.5) against the line through (12, 12) and (24, 24).
  const double ulp = std::numeric_limits<double>::epsilon() / 2;
  for (int i = 0; i < 256; ++i)
    for (int j = 0; j < 256; ++j)
      ASSERT_EQ(orientation({0.5 + i * ulp, 0.5 + j * ulp}, {12, 12}, {24, 24}), (i < j) - (i > j)) << i << ' ' << j;
}

TEST(Orientation, PermutationsAndTranslationsKeepTheSign) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 5000; ++i) {
    const Vec2 a{unit(random), unit(random)}, b{unit(random), unit(random)};
    const double w = 0.25 * (i % 9);
    const Vec2 c{a.x() + w * (b.x() - a.x()), a.y() + w * (b.y() - a.y())};  // rounded: any sign
    const int s = orientation(a, b, c);
    ASSERT_EQ(s, orientation(b, c, a));
    ASSERT_EQ(s, orientation(c, a, b));
    ASSERT_EQ(s, -orientation(b, a, c));
    ASSERT_EQ(s, -orientation(a, c, b));
    ASSERT_EQ(s, -orientation(c, b, a));
    ASSERT_EQ(s, detail::exact_orientation(a, b, c));
  }
  // Multiples of 2^-30 below 1 moved by 2^20: exactly representable.
  for (int i = 0; i < 5000; ++i) {
    const auto coordinate = [&] { return std::ldexp(static_cast<double>(random() >> 34), -30); };
    const Vec2 a{coordinate(), coordinate()}, b{coordinate(), coordinate()}, t{0x1p20, -0x1p21};
    const Vec2 c{std::ldexp(std::floor(0x1p30 * (0.5 * (a.x() + b.x()))), -30), 0.5 * (a.y() + b.y())};
    if (c.y() + t.y() - t.y() != c.y()) continue;
    ASSERT_EQ(orientation(a, b, c), orientation(a + t, b + t, c + t));
  }
}

TEST(Orientation, SurvivesTheEndsOfTheRange) {
  const double huge = std::numeric_limits<double>::max(), tiny = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(orientation({-huge, -huge}, {huge, -huge}, {huge, huge}), 1);
  EXPECT_EQ(orientation({-huge, -huge}, {huge, huge}, {0, 0}), 0);
  EXPECT_EQ(orientation({-huge, -huge}, {huge, huge}, {0, tiny}), 1);
  EXPECT_EQ(orientation({-huge, -huge}, {huge, huge}, {tiny, 0}), -1);
  EXPECT_EQ(orientation({0, 0}, {tiny, 0}, {0, tiny}), 1);
  EXPECT_EQ(orientation({0, 0}, {tiny, tiny}, {2 * tiny, 2 * tiny}), 0);
  EXPECT_EQ(orientation({0, 0}, {1e-200, 1e-200}, {3e-200, 3e-200 * (1 + 1e-15)}), 1);
  EXPECT_EQ(orientation({0, 0}, {1, tiny}, {2, 0}), -1);
}

TEST(ConvexQuad, AgreesWithIntegersWhereCornersAreAllButFlat) {
  std::mt19937_64 random(7);
  constexpr std::int64_t size = std::int64_t{1} << 50;
  std::uniform_int_distribution<std::int64_t> any(size / 2, size), little(-2, 2);
  std::array<int, 2> seen{};
  for (int i = 0; i < 3000; ++i) {
    const std::int64_t x = any(random), y = any(random), part = any(random);
    const auto on_way = [&](std::int64_t length) {
      return static_cast<std::int64_t>(static_cast<Integer>(length) * part / (2 * size));
    };
    // The second corner lies on the diagonal from the first to the third, but for a unit or two.
    const std::array<std::array<std::int64_t, 2>, 4> p{
        {{0, 0}, {on_way(x) + little(random), on_way(y) + little(random)}, {x, y}, {-any(random), any(random)}}};
    bool convex = true;
    for (std::size_t k = 0; k < 4; ++k)
      convex = convex && integer_orientation({p[k], p[(k + 1) % 4], p[(k + 2) % 4]}) > 0;
    ++seen[convex ? 1 : 0];
    for (const int exponent : {-400, 0, 300}) {
      const auto q = scaled(p, exponent);
      for (std::size_t k = 0; k < 4; ++k)
        EXPECT_EQ(is_convex_quad(q[k], q[(k + 1) % 4], q[(k + 2) % 4], q[(k + 3) % 4]), convex) << i << " " << exponent;
      EXPECT_FALSE(is_convex_quad(q[3], q[2], q[1], q[0]));
    }
  }
  EXPECT_GT(seen[0], 300);
  EXPECT_GT(seen[1], 300);
}

TEST(InCircle, AgreesWithIntegersNearCocircularAtEveryScale) {
  std::mt19937_64 random(4);
  // Points of the circle of radius 5 * 13 * 17 * 29 about an integer centre, from Pythagorean triples: cocircular
  // exactly; one of them moved by one unit in most trials.
  const std::array<std::array<std::int64_t, 2>, 4> direction{{{3, 4}, {5, 12}, {8, 15}, {20, 21}}};
  const std::array<std::int64_t, 4> hypotenuse{5, 13, 17, 29};
  std::array<int, 3> seen{};
  for (int i = 0; i < 3000; ++i) {
    const std::int64_t r = 32045 * (1 + i % 50);
    const std::int64_t x0 = static_cast<std::int64_t>(random() >> 42), y0 = static_cast<std::int64_t>(random() >> 42);
    std::array<std::array<std::int64_t, 2>, 4> p;
    for (std::size_t k = 0; k < 4; ++k) {
      std::int64_t x = direction[k][0] * (r / hypotenuse[k]), y = direction[k][1] * (r / hypotenuse[k]);
      const std::uint64_t turns = random() % 8;
      if ((turns & 1) != 0) x = -x;
      if ((turns & 2) != 0) y = -y;
      if ((turns & 4) != 0) std::swap(x, y);
      p[k] = {x0 + x, y0 + y};
    }
    p[static_cast<std::size_t>(i % 4)][0] += i % 3 - 1;
    const int expected = integer_in_circle(p);
    ++seen[static_cast<std::size_t>(expected + 1)];
    for (const int e : exponents(30)) ASSERT_EQ(in_circle_of(scaled(p, e)), expected) << i << " scale 2^" << e;
    const auto q = scaled(p, 0);
    ASSERT_EQ(detail::exact_in_circle(q[0], q[1], q[2], q[3]), expected);
  }
  for (const int count : seen) EXPECT_GT(count, 300);
}

TEST(InCircle, PermutationsKeepTheSign) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> angle(0, 6.283185307179586);
  for (int i = 0; i < 3000; ++i) {
    std::array<Vec2, 4> p;  // on the unit circle up to rounding
    for (Vec2& q : p) {
      const double t = angle(random);
      q = {100 + std::cos(t), std::sin(t)};
    }
    const int s = in_circle_of(p);
    ASSERT_EQ(s, in_circle(p[1], p[2], p[0], p[3]));
    ASSERT_EQ(s, -in_circle(p[1], p[0], p[2], p[3]));
    ASSERT_EQ(s, -in_circle(p[0], p[1], p[3], p[2]));  // an odd permutation of the rows of the 4 x 4 determinant
    ASSERT_EQ(s, -in_circle(p[3], p[1], p[2], p[0]));
    ASSERT_EQ(s, detail::exact_in_circle(p[0], p[1], p[2], p[3]));
  }
}

TEST(InCircle, IsExactWhenDifferencesRound) {
  // The unit square's corners with the fourth moved by one ulp of 2: inside when moved inwards.
  const double big = 0x1p40, one_ulp = 0x1p-52;
  EXPECT_EQ(in_circle({0, 0}, {1, 0}, {1, 1}, {0, 1}), 0);
  EXPECT_EQ(in_circle({0, 0}, {1, 0}, {1, 1}, {0, 1 - one_ulp}), 1);
  EXPECT_EQ(in_circle({0, 0}, {1, 0}, {1, 1}, {0, 1 + one_ulp}), -1);
  EXPECT_EQ(in_circle({0, 0}, {big, 0}, {big, big}, {0, 0x1p-60}), 1);
  EXPECT_EQ(in_circle({0, 0}, {big, 0}, {big, big}, {0, -0x1p-60}), -1);
  EXPECT_EQ(in_circle({0, 0}, {big, 0}, {big, big}, {0x1p-500, 0x1p-500}), 1);
  EXPECT_EQ(in_circle({0, 0}, {big, 0}, {big, big}, {-0x1p-1074, 0}), -1);
  const double huge = std::numeric_limits<double>::max();
  EXPECT_EQ(in_circle({-huge, -huge}, {huge, -huge}, {huge, huge}, {-huge, huge}), 0);
  EXPECT_EQ(in_circle({-huge, -huge}, {huge, -huge}, {huge, huge}, {0, 0x1p-1074}), 1);
  EXPECT_EQ(in_circle({-huge, -huge}, {huge, -huge}, {huge, huge}, {-huge, std::nextafter(huge, 0)}), 1);
}

TEST(Predicates, ScalingByPowersOfTwoKeepsTheSignOfMixedMagnitudes) {
  // The scaled coordinates take the integer path, the others the floating-point expansions: two methods, one sign.
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto coordinate = [&] { return std::ldexp(unit(random), -static_cast<int>(random() % 60)); };
  const auto times = [](Vec2 p, int e) { return Vec2{std::ldexp(p.x(), e), std::ldexp(p.y(), e)}; };
  for (int i = 0; i < 2000; ++i) {
    const Vec2 a{coordinate(), coordinate()}, b{coordinate(), coordinate()};
    const double w = unit(random);
    const Vec2 c = lerp(a, b, w);                                    // nearly collinear
    const Vec2 d{c.x() - (b.y() - a.y()) * 0.5, c.y() + (b.x() - a.x()) * 0.5};  // somewhere
    const Vec2 e{a.x() + b.x() - d.x(), a.y() + b.y() - d.y()};                  // a d b e is nearly a rectangle when w is 1/2
    for (const int k : {-800, 900}) {
      ASSERT_EQ(orientation(a, b, c), orientation(times(a, k), times(b, k), times(c, k))) << i;
      ASSERT_EQ(in_circle(a, d, b, e), in_circle(times(a, k), times(d, k), times(b, k), times(e, k))) << i;
      ASSERT_EQ(in_circle(a, c, b, d), in_circle(times(a, k), times(c, k), times(b, k), times(d, k))) << i;
    }
    ASSERT_EQ(detail::exact_in_circle(a, c, b, d), in_circle(a, c, b, d)) << i;
  }
}

}  // namespace
}  // namespace carreau
