// SPDX-License-Identifier: BSD-3-Clause
#include "metric/metric3_algebra.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "support/infinity.h"

namespace carreau {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::array laws{MetricLaw::linear, MetricLaw::geometric, MetricLaw::sinusoidal};

struct Rotation {
  std::array<Vec3, 3> column;
  [[nodiscard]] Vec3 operator()(Vec3 p) const { return p.x() * column[0] + p.y() * column[1] + p.z() * column[2]; }
};

class Random {
 public:
  double unit() { return unit_(engine_); }
  Vec3 direction() {
    const double z = 2 * unit() - 1, a = 2 * pi * unit(), r = std::sqrt(1 - z * z);
    return {r * std::cos(a), r * std::sin(a), z};
  }
  Rotation rotation() {
    const Vec3 x = direction();
    Vec3 y = cross(x, direction());
    y = (1 / norm(y)) * y;
    return {{x, y, cross(x, y)}};
  }
  // Sizes over six decades, conditions up to 10^decades.
  Metric3 metric(double decades = 12) {
    const double scale = std::pow(10, 6 * unit() - 3);
    const Rotation r = rotation();
    std::array<double, 3> v{scale, scale * std::pow(10, -decades * unit()), scale * std::pow(10, -decades * unit())};
    std::sort(v.begin(), v.end(), std::greater<>());
    return compose(Eigen3{v, r.column});
  }

 private:
  std::mt19937_64 engine_{20261121};
  std::uniform_real_distribution<double> unit_{0, 1};
};

double largest_entry(const Metric3& m) {
  return std::max({std::abs(m.xx), std::abs(m.yy), std::abs(m.zz), std::abs(m.xy), std::abs(m.xz), std::abs(m.yz)});
}
double distance(const Metric3& m, const Metric3& n) {
  return largest_entry({m.xx - n.xx, m.xy - n.xy, m.xz - n.xz, m.yy - n.yy, m.yz - n.yz, m.zz - n.zz}) /
         largest_entry(n);
}
// Q M Q^T.
Metric3 rotated(const Metric3& m, const Rotation& q) {
  Eigen3 e = eigen(m);
  for (Vec3& axis : e.axis) axis = q(axis);
  return compose(e);
}
Metric3 times(double s, const Metric3& m) { return {s * m.xx, s * m.xy, s * m.xz, s * m.yy, s * m.yz, s * m.zz}; }
/// Expects that the unit ball of `inner` lies inside the unit ball of `outer`: no length in `outer` exceeds the length
/// in `inner`. Entries of tensors of condition 1e12 leave a relative error `slack` of eigenvalues.
void expect_inside(const Metric3& inner, const Metric3& outer, double slack) {
  EXPECT_LE(length_ratios(outer, inner).largest, 1 + slack);
}
/// Directions in which rounding is worst, too: the eigenvectors of both.
void expect_inside_by_directions(const Metric3& inner, const Metric3& outer, Random& random, double slack) {
  const Eigen3 e = eigen(inner), f = eigen(outer);
  std::vector<Vec3> d(e.axis.begin(), e.axis.end());
  d.insert(d.end(), f.axis.begin(), f.axis.end());
  for (int k = 0; k < 20; ++k) d.push_back(random.direction());
  // The effect on a squared length of rounding the entries of either tensor.
  const double rounding = 2e-15 * (largest_entry(inner) + largest_entry(outer));
  for (const Vec3& v : d) EXPECT_LE(squared_length(outer, v), squared_length(inner, v) * (1 + slack) + rounding);
}

TEST(Eigen3, RecoversADecomposition) {
  Random random;
  for (int k = 0; k < 2000; ++k) {
    const Metric3 m = random.metric();
    const Eigen3 e = eigen(m);
    EXPECT_GE(e.value[0], e.value[1]);
    EXPECT_GE(e.value[1], e.value[2]);
    EXPECT_GT(e.value[2], 0);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(dot(e.axis[i], e.axis[j]), i == j, 1e-14);
      EXPECT_LE(norm(apply(m, e.axis[i]) - e.value[i] * e.axis[i]), 1e-14 * e.value[0]);
    }
    EXPECT_LE(distance(compose(e), m), 2e-15);
    EXPECT_TRUE(is_positive_definite(m));
  }
}

TEST(Eigen3, SmallValuesOfDiagonalTensorsAreExact) {
  const Eigen3 e = eigen({1e-6, 0, 0, 1e6, 0, 3});
  EXPECT_NEAR(e.value[0] / 1e6, 1, 1e-15);
  EXPECT_NEAR(e.value[1] / 3, 1, 1e-15);
  EXPECT_NEAR(e.value[2] / 1e-6, 1, 1e-15);
}

TEST(Eigen3, AnySymmetricTensor) {
  Random random;
  for (int k = 0; k < 500; ++k) {
    const Rotation r = random.rotation();
    const std::array<double, 3> v{3, 0, -2};
    const Eigen3 e = eigen(compose(Eigen3{v, r.column}));
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(e.value[i], v[i], 4e-14);
  }
  EXPECT_EQ(eigen({0, 0, 0, 0, 0, 0}).value[0], 0);
}

TEST(PositiveDefinite, DetectsOtherMatrices) {
  const double nan = std::nan("");
  EXPECT_TRUE(is_positive_definite(Metric3{}));
  EXPECT_TRUE(is_positive_definite(Metric3{1e-300, 0, 0, 1e-300, 0, 1e-300}));
  EXPECT_FALSE(is_positive_definite(Metric3{1, 0, 0, 1, 0, 0}));
  EXPECT_FALSE(is_positive_definite(Metric3{1, 1, 0, 1, 0, 1}));
  EXPECT_FALSE(is_positive_definite(Metric3{1, 2, 0, 1, 0, 1}));
  EXPECT_FALSE(is_positive_definite(Metric3{-1, 0, 0, 1, 0, 1}));
  EXPECT_FALSE(is_positive_definite(Metric3{1, nan, 0, 1, 0, 1}));
  EXPECT_FALSE(is_positive_definite(Metric3{1, 0, 0, infinity, 0, 1}));
  EXPECT_TRUE(is_positive_definite(Metric2{1e12, 0, 1e-12}));
  EXPECT_FALSE(is_positive_definite(Metric2{1, 1, 1}));
  EXPECT_FALSE(is_positive_definite(Metric2{1, 0, -1}));
  EXPECT_FALSE(is_positive_definite(Metric2{1, nan, 1}));
}

TEST(SquareRoot3, ItsSquareIsTheTensor) {
  Random random;
  for (int k = 0; k < 1000; ++k) {
    const Metric3 m = random.metric(), s = square_root(m);
    const Vec3 x = apply(s, {1, 0, 0}), y = apply(s, {0, 1, 0}), z = apply(s, {0, 0, 1});
    EXPECT_LE(distance({dot(x, x), dot(x, y), dot(x, z), dot(y, y), dot(y, z), dot(z, z)}, m), 1e-14);
  }
}

TEST(Clamp3, BoundsEigenvaluesAndKeepsAxes) {
  Random random;
  for (int k = 0; k < 1000; ++k) {
    const Metric3 m = random.metric();
    const Eigen3 e = eigen(m);
    const double low = e.value[1] * 0.5, high = std::max(low, e.value[0] * 0.7);
    const Metric3 c = clamp_eigenvalues(m, low, high);
    Eigen3 expected = e;
    for (double& v : expected.value) v = std::clamp(v, low, high);
    EXPECT_LE(distance(c, compose(expected)), 1e-14);
    const Metric3 same = clamp_eigenvalues(m, 0, 2 * e.value[0]);
    EXPECT_TRUE(same == m);
  }
}

TEST(Reduction3, BothTensorsComeBack) {
  Random random;
  for (int k = 0; k < 3000; ++k) {
    const Metric3 p = random.metric(), q = random.metric();
    const Reduction3 r = reduce(p, q);
    EXPECT_LE(distance(compose({{1, 1, 1}, r.axis}), p), 1e-14);
    EXPECT_LE(distance(compose({r.ratio, r.axis}), q), 1e-9) << k;  // p of condition 1e12 multiplies the rounding
                                                                    // errors
    EXPECT_GT(r.ratio[2], 0);
  }
}

TEST(Interpolate3, ClosedFormsAlongCommonAxes) {
  Random random;
  for (int k = 0; k < 500; ++k) {
    const Rotation r = random.rotation();
    const std::array<double, 3> h1{1, 2, 0.01}, h2{3, 0.5, 0.2};
    Eigen3 p{{}, r.column}, q{{}, r.column};
    for (std::size_t i = 0; i < 3; ++i) p.value[i] = 1 / (h1[i] * h1[i]), q.value[i] = 1 / (h2[i] * h2[i]);
    const double t = random.unit();
    for (const MetricLaw law : laws) {
      const Metric3 m = interpolate(compose(p), compose(q), t, law);
      for (std::size_t i = 0; i < 3; ++i) {
        // RR-2818 sec. 4.3.2, the three laws.
        const double expected = law == MetricLaw::linear ? h1[i] + t * (h2[i] - h1[i])
                                : law == MetricLaw::geometric
                                    ? h1[i] * std::pow(h2[i] / h1[i], t)
                                    : 0.5 * (h1[i] + h2[i] + (h1[i] - h2[i]) * std::cos(pi * t));
        EXPECT_NEAR(1 / length(m, r.column[i]) / expected, 1, 1e-10);
      }
    }
  }
}

// RR-2818 fig. 14-17: along the axes of the reduction, sizes go monotonically from one metric's to the other's.
TEST(Interpolate3, MonotoneAlongTheAxesOfTheReductionAndPositiveDefinite) {
  Random random;
  for (int k = 0; k < 300; ++k) {
    const Metric3 p = random.metric(6), q = random.metric(6);
    const Reduction3 r = reduce(p, q);
    for (const MetricLaw law : laws) {
      // Conjugate directions are dual to the axes.
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 d = cross(r.axis[(i + 1) % 3], r.axis[(i + 2) % 3]);
        const double first = 1 / length(p, d), last = 1 / length(q, d);
        double previous = first;
        for (int j = 1; j <= 16; ++j) {
          const Metric3 m = interpolate(p, q, j / 16.0, law);
          EXPECT_TRUE(is_positive_definite(m));
          const double h = 1 / length(m, d);
          const double sign = last > first ? 1 : -1;
          EXPECT_GE(sign * (h - previous), -1e-6 * std::max(first, last));
          previous = h;
        }
      }
      EXPECT_TRUE(interpolate(p, q, 0, law) == p);
      EXPECT_TRUE(interpolate(p, q, 1, law) == q);
      const bool symmetric = interpolate(p, q, 0.375, law) == interpolate(q, p, 0.625, law);
      EXPECT_TRUE(symmetric);
    }
  }
}

TEST(Interpolate3, InvariantUnderRotationAndScaling) {
  Random random;
  for (int k = 0; k < 500; ++k) {
    const Metric3 p = random.metric(5), q = random.metric(5);
    const Rotation r = random.rotation();
    const double t = random.unit();
    for (const MetricLaw law : laws) {
      const Metric3 m = interpolate(p, q, t, law);
      EXPECT_LE(distance(interpolate(rotated(p, r), rotated(q, r), t, law), rotated(m, r)), 1e-6);
      EXPECT_LE(distance(interpolate(times(1e4, p), times(1e4, q), t, law), times(1e4, m)), 1e-10);
    }
  }
}

TEST(Intersection3, UnitBallInsideBothUpToConditions1e12) {
  Random random;
  for (int k = 0; k < 3000; ++k) {
    const Metric3 p = random.metric(12), q = random.metric(12), m = intersection(p, q);
    EXPECT_TRUE(is_positive_definite(m));
    expect_inside(m, p, 2e-3);
    expect_inside(m, q, 2e-3);
    expect_inside_by_directions(m, p, random, 1e-9);
    expect_inside_by_directions(m, q, random, 1e-9);
    const bool symmetric = m == intersection(q, p);
    EXPECT_TRUE(symmetric);
  }
}

TEST(Intersection3, TightAlongEveryAxisOfTheReduction) {
  Random random;
  for (int k = 0; k < 1000; ++k) {
    const Metric3 p = random.metric(5), q = random.metric(5), m = intersection(p, q);
    const Reduction3 r = reduce(p, q);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 d = cross(r.axis[(i + 1) % 3], r.axis[(i + 2) % 3]);
      EXPECT_NEAR(length(m, d) / std::max(length(p, d), length(q, d)), 1, 1e-5);
    }
  }
}

TEST(Intersection3, ClosedForms) {
  const Metric3 p{1, 0, 0, 4, 0, 9}, q{2, 0, 0, 3, 0, 1};
  EXPECT_LE(distance(intersection(p, q), {2, 0, 0, 4, 0, 9}), 1e-15);
  EXPECT_TRUE(intersection(p, p) == p);
  EXPECT_LE(distance(intersection(isotropic_metric3(0.5), isotropic_metric3(2)), isotropic_metric3(0.5)), 1e-15);
}

TEST(Intersection3, InvariantUnderRotationAndScaling) {
  Random random;
  for (int k = 0; k < 500; ++k) {
    const Metric3 p = random.metric(5), q = random.metric(5), m = intersection(p, q);
    const Rotation r = random.rotation();
    EXPECT_LE(distance(intersection(rotated(p, r), rotated(q, r)), rotated(m, r)), 1e-6);
    EXPECT_LE(distance(intersection(times(1e-4, p), times(1e-4, q)), times(1e-4, m)), 1e-12);
  }
}

TEST(IntersectionOfMany, InsideAllAndIndependentOfTheOrder) {
  Random random;
  for (int k = 0; k < 300; ++k) {
    std::vector<Metric3> all;
    for (int i = 0; i < 5; ++i) all.push_back(random.metric(12));
    const Metric3 m = intersection(all);
    for (const Metric3& p : all) expect_inside_by_directions(m, p, random, 1e-9);
    std::reverse(all.begin(), all.end());
    std::swap(all[1], all[3]);
    const bool same = intersection(all) == m;
    EXPECT_TRUE(same);
    const Rotation r = random.rotation();
    for (Metric3& p : all) p = random.metric(4);
    const Metric3 n = intersection(all);
    for (Metric3& p : all) p = rotated(p, r);
    EXPECT_LE(distance(intersection(all), rotated(n, r)), 1e-6);
  }
}

TEST(IntersectionOfMany, InThePlane) {
  Random random;
  for (int k = 0; k < 300; ++k) {
    std::vector<Metric2> all;
    for (int i = 0; i < 4; ++i) {
      const double a = pi * random.unit(), s = std::pow(10, 4 * random.unit());
      all.push_back(compose(Eigen2{s, s * std::pow(10, -6 * random.unit()), {std::cos(a), std::sin(a)}}));
    }
    const Metric2 m = intersection(all);
    for (const Metric2 p : all) EXPECT_LE(length_ratios(p, m).largest, 1 + 1e-6);
    std::reverse(all.begin(), all.end());
    const bool same = intersection(all) == m;
    EXPECT_TRUE(same);
  }
}

// RR-2928 sec. 5.3: "scale" keeps the shape and touches; "intersection" is at least as large.
TEST(Combine, KeepsTheShapeOrIntersects) {
  Random random;
  for (int k = 0; k < 1000; ++k) {
    const Metric3 p = random.metric(6), g = random.metric(6);
    const Metric3 s = combine(p, g, MetricCombination::scale);
    expect_inside_by_directions(s, p, random, 1e-9);
    expect_inside_by_directions(s, g, random, 1e-6);
    const double factor = s.xx / p.xx;
    EXPECT_LE(distance(s, times(factor, p)), 1e-15);
    // The largest of its shape: it touches one of both.
    const double touch = std::max(length_ratios(g, s).largest, 1 / std::sqrt(factor));
    EXPECT_NEAR(touch, 1, 1e-6);
    const Metric3 i = combine(p, g, MetricCombination::intersection);
    EXPECT_LE(length_ratios(i, s).largest, 1 + 1e-6);
  }
  const Metric2 p{1, 0, 4}, g{9, 0, 1};
  EXPECT_EQ(combine(p, g, MetricCombination::scale), (Metric2{9, 0, 36}));
  EXPECT_NEAR(combine(p, g, MetricCombination::intersection).a, 9, 1e-14);
  EXPECT_NEAR(combine(p, g, MetricCombination::intersection).c, 4, 1e-14);
}

// HDR eq. 4.58, 4.63, 4.65, 4.66: lengths of images are lengths in the induced metric.
TEST(Induced, LengthsOfImages) {
  Random random;
  for (int k = 0; k < 1000; ++k) {
    const Vec3 su = (0.1 + random.unit()) * random.direction(), sv = (1 + 9 * random.unit()) * random.direction();
    const Vec2 d{random.unit() - 0.5, random.unit() - 0.5};
    const Vec3 image = d.x() * su + d.y() * sv;
    const double scale = norm(su) + norm(sv);
    EXPECT_NEAR(length(induced_metric(su, sv, 1.0), d), norm(image), 1e-13 * scale);
    EXPECT_NEAR(length(induced_metric(su, sv, 0.25), d), 4 * norm(image), 1e-12 * scale);
    const Metric3 m = random.metric(4);
    EXPECT_NEAR(length(induced_metric(su, sv, m), d), length(m, image), 1e-12 * scale * std::sqrt(largest_entry(m)));
    const auto frame = TangentFrame::of(su, sv);
    ASSERT_TRUE(frame);
    const double a = pi * random.unit(), h1 = 0.1 + random.unit(), h2 = 0.1 + random.unit();
    const Vec3 w1 = std::cos(a) * frame->e1 + std::sin(a) * frame->e2;
    const Vec3 w2 = std::cos(a) * frame->e2 - std::sin(a) * frame->e1;
    const Metric2 t = compose(Eigen2{1 / (h1 * h1), 1 / (h2 * h2), {std::cos(a), std::sin(a)}});
    const double expected = std::hypot(dot(w1, image) / h1, dot(w2, image) / h2);
    EXPECT_NEAR(length(frame->induced(t), d) / expected, 1, 1e-9);
    // The same from a direction and two sizes, through a metric of space.
    EXPECT_NEAR(length(induced_metric(su, sv, metric_of_sizes(3.0 * w1, h1, h2)), d) / expected, 1, 1e-9);
    const Metric2 back = frame->of_parameters(frame->induced(t));
    const double conditioning = norm(su) * norm(sv) / norm(cross(su, sv));
    EXPECT_NEAR(back.a, t.a, 1e-13 * conditioning * conditioning * (t.a + t.c));
    EXPECT_NEAR(back.b, t.b, 1e-13 * conditioning * conditioning * (t.a + t.c));
    EXPECT_NEAR(back.c, t.c, 1e-13 * conditioning * conditioning * (t.a + t.c));
    const Metric2 restricted = frame->restricted(frame->in_space(t, 5));
    EXPECT_NEAR(restricted.a, t.a, 1e-12 * (t.a + t.c));
    EXPECT_NEAR(restricted.b, t.b, 1e-12 * (t.a + t.c));
    EXPECT_NEAR(restricted.c, t.c, 1e-12 * (t.a + t.c));
  }
  EXPECT_FALSE(TangentFrame::of({0, 0, 0}, {0, 1, 0}));
  EXPECT_FALSE(TangentFrame::of({1, 1, 0}, {2, 2, 0}));
}

}  // namespace
}  // namespace carreau
