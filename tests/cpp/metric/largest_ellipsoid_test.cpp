// SPDX-License-Identifier: BSD-3-Clause
// The largest ellipsoid inside many: closed forms, conditions of optimality, invariance.
#include "metric/largest_ellipsoid.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace carreau {
namespace {

constexpr double pi = std::numbers::pi;

Metric2 ellipse(double h1, double h2, double angle) {
  return compose(Eigen2{1 / (h1 * h1), 1 / (h2 * h2), {std::cos(angle), std::sin(angle)}});
}
double determinant3(const Metric3& m) {
  return Eigen::Matrix3d{{m.xx, m.xy, m.xz}, {m.xy, m.yy, m.yz}, {m.xz, m.yz, m.zz}}.determinant();
}
Metric3 random_metric(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::Matrix3d a;
  for (int i = 0; i < 9; ++i) a(i / 3, i % 3) = uniform(random);
  const Eigen::Matrix3d q = a.householderQr().householderQ();
  const Eigen::Vector3d sizes = Eigen::Vector3d::NullaryExpr([&] { return std::pow(10, 2 * uniform(random)); });
  const Eigen::Matrix3d m = q * sizes.asDiagonal() * q.transpose();
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)};
}

TEST(LargestEllipsoid, IsTheIntersectionOfTwo) {
  const Metric2 p = ellipse(1, 0.2, 0.3), q = ellipse(0.7, 0.1, 1.4);
  EXPECT_EQ(largest_inside(std::array{p, q}), intersection(p, q));
  EXPECT_EQ(largest_inside(std::array{p, p, q, q, p}), intersection(p, q));
  EXPECT_EQ(largest_inside(std::array{p}), p);
}

TEST(LargestEllipsoid, IsACircleForEllipsesTurnedEvenly) {
  // A ball, by symmetry; its radius is their small half axis. Pairwise intersections in turn leave less.
  for (const int n : {3, 4, 7}) {
    std::vector<Metric2> metrics;
    for (int k = 0; k < n; ++k) metrics.push_back(ellipse(0.2, 1, 0.1 + k * pi / n));
    const Metric2 m = largest_inside(metrics);
    EXPECT_NEAR(m.a, 25, 1e-7);
    EXPECT_NEAR(m.b, 0, 1e-7);
    EXPECT_NEAR(m.c, 25, 1e-7);
    EXPECT_GT(determinant(intersection(std::span<const Metric2>(metrics))), determinant(m) * 1.01);
  }
}

TEST(LargestEllipsoid, IsInsideAllAndSatisfiesTheConditionsOfOptimality) {
  // John's theorem for centred ellipsoids: where the ball touches the others, in coordinates in which it is the unit
  // ball, weights w > 0 and unit vectors v give sum w v v^T = I. The residual of the best weights shows it.
  std::mt19937 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Metric3> metrics;
    for (int k = 0; k < 3 + trial % 6; ++k) metrics.push_back(random_metric(random));
    const Metric3 found = largest_inside(metrics);
    const Eigen::Matrix3d m{{found.xx, found.xy, found.xz}, {found.xy, found.yy, found.yz}, {found.xz, found.yz, found.zz}};
    const Eigen::Matrix3d l = m.llt().matrixL();
    std::vector<Eigen::Matrix3d> touching;
    for (const Metric3& each : metrics) {
      EXPECT_LE(length_ratios(each, found).largest, 1 + 1e-12) << trial;
      const Eigen::Matrix3d a{{each.xx, each.xy, each.xz}, {each.xy, each.yy, each.yz}, {each.xz, each.yz, each.zz}};
      const Eigen::Matrix3d b = l.inverse() * a * l.inverse().transpose();
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(b);
      for (int i = 0; i < 3; ++i)
        if (solver.eigenvalues()(i) > 1 - 1e-5)
          touching.push_back(solver.eigenvectors().col(i) * solver.eigenvectors().col(i).transpose());
    }
    // Weights by multiplicative updates from even ones, which stay positive.
    std::vector<double> w(touching.size(), 3.0 / static_cast<double>(touching.size()));
    Eigen::Matrix3d sum;
    for (int round = 0; round < 20'000; ++round) {
      sum.setZero();
      for (std::size_t k = 0; k < w.size(); ++k) sum += w[k] * touching[k];
      if ((sum - Eigen::Matrix3d::Identity()).norm() < 1e-3) break;
      const Eigen::Matrix3d inverse = (sum + 1e-12 * Eigen::Matrix3d::Identity()).inverse();
      for (std::size_t k = 0; k < w.size(); ++k) w[k] *= (touching[k] * inverse).trace();
    }
    EXPECT_LT((sum - Eigen::Matrix3d::Identity()).norm(), 2e-2) << trial << ", " << touching.size() << " touch";
    EXPECT_LE(determinant3(found), determinant3(intersection(std::span<const Metric3>(metrics))) * (1 + 1e-8));
  }
}

TEST(LargestEllipsoid, DoesNotDependOnOrderAndFollowsCoordinates) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<Metric3> metrics;
    for (int k = 0; k < 5; ++k) metrics.push_back(random_metric(random));
    const Metric3 m = largest_inside(metrics);
    std::shuffle(metrics.begin(), metrics.end(), random);
    EXPECT_EQ(largest_inside(metrics), m);
    // Twice as long along x.
    for (Metric3& each : metrics) each = {each.xx / 4, each.xy / 2, each.xz / 2, each.yy, each.yz, each.zz};
    const Metric3 stretched = largest_inside(metrics), expected{m.xx / 4, m.xy / 2, m.xz / 2, m.yy, m.yz, m.zz};
    const LengthRatios ratios = length_ratios(stretched, expected);
    EXPECT_NEAR(ratios.largest, 1, 1e-6);
    EXPECT_NEAR(ratios.smallest, 1, 1e-6);
  }
}

}  // namespace
}  // namespace carreau
