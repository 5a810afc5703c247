// SPDX-License-Identifier: BSD-3-Clause
// The reason why some algebra of this folder is not Eigen's: tensors whose decompositions are known exactly, with the
// bound of ours and the results of Eigen's solvers for the same entries.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "metric/metric3_algebra.h"

namespace carreau {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

Eigen::Matrix2d matrix(Metric2 m) { return (Eigen::Matrix2d() << m.a, m.b, m.b, m.c).finished(); }
Eigen::Matrix3d matrix(const Metric3& m) {
  return (Eigen::Matrix3d() << m.xx, m.xy, m.xz, m.xy, m.yy, m.yz, m.xz, m.yz, m.zz).finished();
}

double error(double value, long double exact) { return static_cast<double>(std::abs(value / exact - 1)); }

/// x x^T + y y^T of whole numbers below 2^26, so that no entry is rounded; its determinant is (x, y)^2.
struct ExactTensor {
  Metric2 m;
  long double major, minor;
};

ExactTensor next_tensor(std::mt19937_64& engine) {
  std::uniform_int_distribution<std::int64_t> large(1 << 24, 1 << 26), small(-40, 40);
  std::int64_t px = large(engine), py = large(engine), qx = 0, qy = 0;
  while (px * qy == py * qx) qx = small(engine), qy = small(engine);
  const std::int64_t a = px * px + qx * qx, b = px * py + qx * qy, c = py * py + qy * qy;
  const long double area = static_cast<long double>(px * qy - py * qx), half = 0.5L * static_cast<long double>(a - c);
  ExactTensor t{{static_cast<double>(a), static_cast<double>(b), static_cast<double>(c)}, 0, 0};
  t.major = 0.5L * static_cast<long double>(a + c) + std::sqrt(half * half + static_cast<long double>(b) * b);
  t.minor = area * area / t.major;
  return t;
}

TEST(AgainstEigen, TheSmallEigenvalueOfAPlaneTensorKeepsItsDigitsHereOnly) {
  std::mt19937_64 engine{1};
  double ours = 0, iterated = 0, direct = 0;
  for (int k = 0; k < 1000; ++k) {
    const ExactTensor t = next_tensor(engine);
    ours = std::max(ours, error(eigen(t.m).minor, t.minor));
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(matrix(t.m));
    iterated = std::max(iterated, error(solver.eigenvalues()[0], t.minor));
    direct = std::max(direct, error(solver.computeDirect(matrix(t.m)).eigenvalues()[0], t.minor));
  }
  EXPECT_LT(ours, 4 * epsilon);
  EXPECT_GT(iterated, 1e-3);
  EXPECT_GT(direct, 1e-3);
}

TEST(AgainstEigen, RatiosOfLengthsKeepTheirDigitsHereOnly) {
  std::mt19937_64 engine{2};
  double ours = 0, theirs = 0;
  for (int k = 0; k < 1000; ++k) {
    const ExactTensor t = next_tensor(engine);
    const LengthRatios r = length_ratios({1, 0, 1}, t.m);
    ours = std::max({ours, error(r.largest, 1 / std::sqrt(t.minor)), error(r.smallest, 1 / std::sqrt(t.major))});
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> solver(Eigen::Matrix2d(Eigen::Matrix2d::Identity()),
                                                                            matrix(t.m), Eigen::EigenvaluesOnly);
    theirs = std::max(theirs, error(std::sqrt(solver.eigenvalues()[1]), 1 / std::sqrt(t.minor)));
  }
  EXPECT_LT(ours, 8 * epsilon);
  EXPECT_GT(theirs, 1e-3);
}

TEST(AgainstEigen, TheSquareRootOfAPlaneTensorKeepsItsSmallEigenvalueHereOnly) {
  std::mt19937_64 engine{3};
  double ours = 0, theirs = 0;
  for (int k = 0; k < 1000; ++k) {
    const ExactTensor t = next_tensor(engine);
    ours = std::max(ours, error(eigen(square_root(t.m)).minor, std::sqrt(t.minor)));
    const Eigen::Matrix2d s = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(matrix(t.m)).operatorSqrt();
    theirs = std::max(theirs, error(eigen(Metric2{s(0, 0), s(0, 1), s(1, 1)}).minor, std::sqrt(t.minor)));
  }
  EXPECT_LT(ours, 1e-7);  // the square root of the condition, times the error by rounding the entries of the root
  EXPECT_FALSE(theirs < 1e-3);
}

/// D A D with A = (4 1 1; 1 4 1; 1 1 4) and D = diag(1, s, s^2): positive definite, all entries exact. Its determinant
/// is 54 s^6; the inverse of A is (5 -1 -1; -1 5 -1; -1 -1 5) / 18.
struct Graded {
  explicit Graded(double s)
      : m{4, s, s * s, 4 * s * s, s * s * s, 4 * s * s * s * s},
        determinant(54 * std::pow(s, 6)),
        trace_of_inverse(5 / 18. * (1 + 1 / (s * s) + 1 / (s * s * s * s))) {}
  /// The error of eigenvalues, whose product and sum of inverses are known.
  [[nodiscard]] double error_of(double p, double q, double r) const {
    return std::max(error(p * q * r, determinant), error(1 / p + 1 / q + 1 / r, trace_of_inverse));
  }
  Metric3 m;
  double determinant, trace_of_inverse;
};

TEST(AgainstEigen, SmallEigenvaluesOfATensorOfSpaceKeepTheirDigitsHereOnly) {
  for (int k = 4; k <= 20; k += 4) {
    const Graded t(std::ldexp(1, k));
    const Eigen3 e = eigen(t.m);
    EXPECT_LT(t.error_of(e.value[0], e.value[1], e.value[2]), 16 * epsilon) << k;
    const Reduction3 r = reduce({1, 0, 0, 1, 0, 1}, t.m);
    EXPECT_LT(t.error_of(r.ratio[0], r.ratio[1], r.ratio[2]), 16 * epsilon) << k;
    if (k < 12) continue;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix(t.m));
    const Eigen::Vector3d iterated = solver.eigenvalues();
    const Eigen::Vector3d direct = solver.computeDirect(matrix(t.m)).eigenvalues();
    EXPECT_GT(t.error_of(iterated[0], iterated[1], iterated[2]), 1e-3) << k;
    EXPECT_GT(t.error_of(direct[0], direct[1], direct[2]), 1e-3) << k;
    const Eigen::Vector3d ratios = Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d>(
                                       matrix(t.m), Eigen::Matrix3d(Eigen::Matrix3d::Identity()))
                                       .eigenvalues();
    EXPECT_GT(t.error_of(ratios[0], ratios[1], ratios[2]), 1e-3) << k;
  }
}

/// sum of value axis axis^T against the tensor, relative to its largest entry.
double distance(const Eigen::Matrix3d& axes, const Eigen::Vector3d& values, const Eigen::Matrix3d& m) {
  return (axes * values.asDiagonal() * axes.transpose() - m).cwiseAbs().maxCoeff() / m.cwiseAbs().maxCoeff();
}

TEST(AgainstEigen, SingularValuesOfTheFactorByEigenKeepSmallEigenvaluesAndLoseDigitsOfTheTensor) {
  std::mt19937_64 engine{4};
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> decades(-12, 0);
  double ours = 0, two_sided = 0, solver = 0;
  for (int k = 0; k < 2000; ++k) {
    const Eigen::Matrix3d any = Eigen::Matrix3d::NullaryExpr([&] { return normal(engine); });
    const Eigen::Matrix3d turn = Eigen::HouseholderQR<Eigen::Matrix3d>(any).householderQ();
    const Eigen::Vector3d values(1, std::pow(10, decades(engine)), std::pow(10, decades(engine)));
    const Eigen::Matrix3d product = turn * values.asDiagonal() * turn.transpose();
    const Eigen::Matrix3d a = 0.5 * (product + product.transpose());
    const Eigen3 e = eigen(Metric3{a(0, 0), a(0, 1), a(0, 2), a(1, 1), a(1, 2), a(2, 2)});
    const auto axes = (Eigen::Matrix3d() << e.axis[0], e.axis[1], e.axis[2]).finished();
    ours = std::max(ours, distance(axes, {e.value[0], e.value[1], e.value[2]}, a));
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> iterated(a);
    solver = std::max(solver, distance(iterated.eigenvectors(), iterated.eigenvalues(), a));
    const Eigen::LLT<Eigen::Matrix3d> factor(a);
    if (factor.info() != Eigen::Success) continue;
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(factor.matrixL(), Eigen::ComputeFullU);
    two_sided = std::max(two_sided, distance(svd.matrixU(), svd.singularValues().cwiseAbs2(), a));
  }
  EXPECT_LT(ours, 2e-15);
  EXPECT_GT(two_sided, 3e-15);
  EXPECT_GT(solver, 2e-15);
}

}  // namespace
}  // namespace carreau
