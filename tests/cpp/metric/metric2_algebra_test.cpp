// SPDX-License-Identifier: BSD-3-Clause
#include "metric/metric2_algebra.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace carreau {
namespace {

constexpr double pi = std::numbers::pi;

// R(angle) diag(major, minor) R^T.
Metric2 turned(double major, double minor, double angle) {
  return compose({major, minor, {std::cos(angle), std::sin(angle)}});
}

class RandomMetrics {
 public:
  // Sizes over six decades, conditions up to 10^decades.
  Metric2 next(double decades = 12) {
    const double scale = std::pow(10, 6 * unit_(engine_) - 3);
    return turned(scale, scale * std::pow(10, -decades * unit_(engine_)), 2 * pi * unit_(engine_));
  }
  Vec2 direction() {
    const double a = 2 * pi * unit_(engine_);
    return {std::cos(a), std::sin(a)};
  }
  double unit() { return unit_(engine_); }

 private:
  std::mt19937_64 engine_{20260101};
  std::uniform_real_distribution<double> unit_{0, 1};
};

bool is_definite(Metric2 m) { return m.a > 0 && m.c > 0 && accurate_determinant(m) > 0; }

// Relative to the tensor's largest entry.
double distance(Metric2 m, Metric2 n) {
  const double size = std::max({std::abs(n.a), std::abs(n.b), std::abs(n.c)});
  return std::max({std::abs(m.a - n.a), std::abs(m.b - n.b), std::abs(m.c - n.c)}) / size;
}

// (x, y) -> (p x + q y, r y + s x) in new coordinates: M -> A^T M A.
Metric2 pulled_back(Metric2 m, Vec2 column1, Vec2 column2) {
  return {dot(m, column1, column1), dot(m, column1, column2), dot(m, column2, column2)};
}

TEST(AccurateDeterminant, KeepsItsDigitsWhereTheProductsCancel) {
  // (1 + e)(1 - e) - 1 = -e^2 exactly; the naive difference is 0 or an ulp.
  const double e = std::ldexp(1, -30);
  EXPECT_EQ(accurate_determinant({1 + e, 1, 1 - e}), -e * e);
  // 2^27 + 1 squared needs 55 bits.
  const double big = 134217729.0;
  EXPECT_EQ(accurate_determinant({big, big - 1, big}), 2 * big - 1);
}

TEST(Eigen, RecoversValuesAndDirections) {
  RandomMetrics random;
  for (int k = 0; k < 2000; ++k) {
    const double angle = pi * (random.unit() - 0.5), major = std::exp(4 * random.unit()), ratio = random.unit();
    const Eigen2 e = eigen(turned(major, major * ratio, angle));
    EXPECT_NEAR(e.major, major, 1e-13 * major);
    EXPECT_NEAR(e.minor, major * ratio, 1e-13 * major);
    if (ratio < 0.9) {
      EXPECT_NEAR(std::abs(cross(e.direction, {std::cos(angle), std::sin(angle)})), 0, 1e-12);
    }
  }
}

TEST(Eigen, TheSmallValueIsAsGoodAsTheEntriesAllow) {
  RandomMetrics random;
  for (int k = 0; k < 2000; ++k) {
    const Metric2 m = random.next(12);
    const Eigen2 e = eigen(m);
    EXPECT_GT(e.minor, 0);
    EXPECT_NEAR(e.major * e.minor / accurate_determinant(m), 1, 1e-14);
  }
}

TEST(Eigen, TensorsOfAnySignAreAsGood) {
  // The Hessian of a field that bends one way along one direction only has a value near 0 beside a negative one.
  RandomMetrics random;
  for (int k = 0; k < 2000; ++k) {
    const Metric2 m = random.next(30);
    const Eigen2 plus = eigen(m), minus = eigen(-1. * m);
    EXPECT_EQ(minus.minor, -plus.major);
    EXPECT_EQ(minus.major, -plus.minor);
    const double angle = pi * (random.unit() - 0.5), tiny = 1e-16 * (random.unit() - 0.5);
    const Eigen2 e = eigen(turned(tiny, -2, angle));
    EXPECT_NEAR(e.minor, -2, 1e-13);
    EXPECT_NEAR(e.major, 0, 1e-13);
  }
}

TEST(Eigen, ComposeIsTheInverse) {
  RandomMetrics random;
  for (int k = 0; k < 2000; ++k) {
    const Metric2 m = random.next(6);
    EXPECT_LT(distance(compose(eigen(m)), m), 1e-14);
  }
  EXPECT_EQ(compose(eigen({3, 0, 3})), (Metric2{3, 0, 3}));
}

TEST(ClampEigenvalues, LeavesInnerValuesAndBringsTheRestToTheBounds) {
  RandomMetrics random;
  for (int k = 0; k < 2000; ++k) {
    const Metric2 m = random.next(6);
    const Eigen2 before = eigen(m);
    const double low = before.major * 1e-3, high = before.major * 0.5;
    const Eigen2 after = eigen(clamp_eigenvalues(m, low, high));
    EXPECT_NEAR(after.major, high, 1e-13 * high);
    EXPECT_NEAR(after.minor, std::clamp(before.minor, low, high), 1e-12 * high);
    if (before.minor < 0.4 * before.major) {
      EXPECT_NEAR(cross(after.direction, before.direction), 0, 1e-10);
    }
    EXPECT_EQ(clamp_eigenvalues(m, before.minor * 0.5, before.major * 2), m);
  }
}

TEST(ClampEigenvalues, MakesDegenerateAndIndefiniteTensorsDefinite) {
  const double most = std::numeric_limits<double>::max();
  for (const Metric2 m : {Metric2{0, 0, 0}, Metric2{1, 0, 0}, Metric2{1, 1, 1}, Metric2{1, 1.0000001, 1},
                          Metric2{-1e-20, 0, 5}, Metric2{4, 2, 1}}) {
    const Eigen2 e = eigen(clamp_eigenvalues(m, 1e-6, most));
    EXPECT_NEAR(e.minor, 1e-6, 1e-12);
    EXPECT_GE(e.major, 1e-6);
  }
}

TEST(SquareRoot, SquaresToTheMetricAndIsDefinite) {
  RandomMetrics random;
  for (int k = 0; k < 5000; ++k) {
    const Metric2 m = random.next(12), s = square_root(m);
    EXPECT_LT(distance(square(s), m), 4e-16 * 4);
    EXPECT_TRUE(is_definite(s));
  }
  EXPECT_EQ(square_root({0, 0, 0}), (Metric2{0, 0, 0}));
  EXPECT_EQ(square_root({4, 0, 0}), (Metric2{2, 0, 0}));
  EXPECT_EQ(square_root({4, 0, 9}), (Metric2{2, 0, 3}));
}

TEST(LengthRatios, BoundTheRatioInEveryDirectionAndAreReached) {
  RandomMetrics random;
  for (int k = 0; k < 300; ++k) {
    const Metric2 m = random.next(4), n = random.next(4);
    const LengthRatios r = length_ratios(m, n);
    double smallest = 1e300, largest = 0;
    for (int d = 0; d < 200; ++d) {
      // Directions that are uniform for the reference, so that none is missed.
      const Metric2 s = square_root(n);
      const double det = accurate_determinant(s), a = pi * d / 200;
      const Vec2 x{(s.c * std::cos(a) - s.b * std::sin(a)) / det, (s.a * std::sin(a) - s.b * std::cos(a)) / det};
      const double ratio = length(m, x) / length(n, x);
      EXPECT_GE(ratio, r.smallest * (1 - 1e-6));
      EXPECT_LE(ratio, r.largest * (1 + 1e-6));
      smallest = std::min(smallest, ratio), largest = std::max(largest, ratio);
    }
    EXPECT_GT(largest, 0.999 * r.largest);
    EXPECT_LT(smallest * smallest, 1.001 * r.smallest * r.smallest + r.largest * r.largest * 1e-3);
  }
  EXPECT_NEAR(length_error({1.21, 0, 1}, {1, 0, 1}), 0.1, 1e-15);
  EXPECT_NEAR(length_error({0.81, 0, 1}, {1, 0, 1}), 0.1, 1e-15);
}

TEST(Interpolate, IsExactAtBothEndsAndDefiniteBetween) {
  RandomMetrics random;
  for (int k = 0; k < 3000; ++k) {
    const Metric2 p = random.next(12), q = random.next(12);
    for (const MetricLaw law : {MetricLaw::linear, MetricLaw::geometric, MetricLaw::sinusoidal}) {
      EXPECT_EQ(interpolate(p, q, 0, law), p);
      EXPECT_EQ(interpolate(p, q, 1, law), q);
      const double t = random.unit();
      const Metric2 m = interpolate(p, q, t, law);
      EXPECT_TRUE(is_definite(m)) << k;
    }
  }
}

TEST(Interpolate, SizesOfIsotropicMetricsFollowTheLaw) {
  // RR-2818 sec. 4.3.2 and 5.4 with h from 1/2 to 1/8.
  const Metric2 p{4, 0, 4}, q{64, 0, 64};
  const auto size = [&](double t, MetricLaw law) { return 1 / std::sqrt(interpolate(p, q, t, law).a); };
  for (const double t : {0.1, 0.25, 0.5, 0.9}) {
    EXPECT_NEAR(size(t, MetricLaw::linear), 0.5 + t * (0.125 - 0.5), 1e-15);
    EXPECT_NEAR(size(t, MetricLaw::geometric), 0.5 * std::pow(0.25, t), 1e-15);
    EXPECT_NEAR(size(t, MetricLaw::sinusoidal), 0.5 * (0.625 + 0.375 * std::cos(pi * t)), 1e-15);
  }
}

TEST(Interpolate, IsMonotoneAlongTheAxesOfTheReduction) {
  // Common axes: the sizes along them are interpolated each for itself.
  const Metric2 p{1, 0, 100}, q{25, 0, 4};
  double last_x = 1, last_y = 0.1;
  for (int k = 1; k <= 10; ++k) {
    const Metric2 m = interpolate(p, q, 0.1 * k, MetricLaw::linear);
    const double x = 1 / std::sqrt(m.a), y = 1 / std::sqrt(m.c);
    EXPECT_NEAR(m.b, 0, 1e-12);
    EXPECT_NEAR(x, 1 + 0.1 * k * (0.2 - 1), 1e-12);
    EXPECT_NEAR(y, 0.1 + 0.1 * k * (0.5 - 0.1), 1e-12);
    EXPECT_LT(x, last_x);
    EXPECT_GT(y, last_y);
    last_x = x, last_y = y;
  }
}

TEST(Interpolate, IsSymmetricAndFollowsChangesOfCoordinates) {
  RandomMetrics random;
  for (int k = 0; k < 1000; ++k) {
    const Metric2 p = random.next(3), q = random.next(3);
    const double t = random.unit();
    const Vec2 e = random.direction(), f{-e.y(), e.x()};
    const Vec2 c1 = 3.0 * e, c2 = 0.5 * f + 0.4 * e;
    for (const MetricLaw law : {MetricLaw::linear, MetricLaw::geometric}) {
      const Metric2 m = interpolate(p, q, t, law);
      EXPECT_LT(length_error(interpolate(q, p, 1 - t, law), m), 1e-9);
      const Metric2 there = interpolate(pulled_back(p, c1, c2), pulled_back(q, c1, c2), t, law);
      EXPECT_LT(length_error(there, pulled_back(m, c1, c2)), 1e-7);
      const Metric2 scaled = interpolate(7.0 * p, 7.0 * q, t, law);
      EXPECT_LT(length_error(scaled, 7.0 * m), 1e-9);
    }
  }
}

TEST(Intersection, NoVectorIsShorterThanInEither) {
  RandomMetrics random;
  for (int k = 0; k < 1000; ++k) {
    const Metric2 p = random.next(8), q = random.next(8), m = intersection(p, q);
    EXPECT_TRUE(is_definite(m));
    for (int d = 0; d < 50; ++d) {
      const Vec2 x = random.direction();
      // Rounding of the entries moves a squared length by their size.
      const double slack = 1e-13 * (m.a + m.c);
      EXPECT_GE(squared_length(m, x) + slack, std::max(squared_length(p, x), squared_length(q, x)));
    }
  }
}

TEST(Intersection, TakesTheLargerEigenvalueAlongCommonAxesAndTheWholeOfASmallerEllipse) {
  EXPECT_LT(distance(intersection({1, 0, 100}, {25, 0, 4}), {25, 0, 100}), 1e-15);
  EXPECT_EQ(intersection({1, 0, 1}, {4, 1, 9}), (Metric2{4, 1, 9}));
  EXPECT_EQ(intersection({4, 1, 9}, {1, 0, 1}), (Metric2{4, 1, 9}));
  const Metric2 m{2, 0.5, 3};
  EXPECT_LT(distance(intersection(m, m), m), 1e-15);
}

TEST(Intersection, IsSymmetricAndTurnsWithTheCoordinates) {
  RandomMetrics random;
  for (int k = 0; k < 1000; ++k) {
    const Metric2 p = random.next(4), q = random.next(4);
    EXPECT_EQ(intersection(p, q), intersection(q, p));
    const Vec2 e = random.direction(), f{-e.y(), e.x()};
    const Metric2 there = intersection(pulled_back(p, e, f), pulled_back(q, e, f));
    EXPECT_LT(length_error(there, pulled_back(intersection(p, q), e, f)), 1e-8);
  }
}

}  // namespace
}  // namespace carreau
