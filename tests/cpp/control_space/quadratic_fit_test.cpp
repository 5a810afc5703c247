// SPDX-License-Identifier: BSD-3-Clause
#include "control_space/quadratic_fit.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>
#include <vector>

namespace carreau::detail {
namespace {

struct Sample {
  double x, y, weight;
  Metric2 value;
};

std::vector<Sample> random_samples(std::mt19937_64& engine, int count) {
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<Sample> samples;
  for (int k = 0; k < count; ++k)
    samples.push_back({unit(engine), unit(engine), 1.5 + unit(engine), {unit(engine), unit(engine), unit(engine)}});
  return samples;
}

TEST(QuadraticFit, ItsValueIsTheConstantTermOfEigensSolution) {
  using Vector = Eigen::Matrix<double, 6, 1>;
  std::mt19937_64 engine{1};
  for (int trial = 0; trial < 200; ++trial) {
    QuadraticFit fit;
    Eigen::Matrix<double, 6, 6> left = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::Matrix<double, 6, 3> right = Eigen::Matrix<double, 6, 3>::Zero();
    for (const Sample& s : random_samples(engine, 30)) {
      fit.add(s.x, s.y, s.weight, s.value);
      const Vector basis = (Vector() << 1, s.x, s.y, s.x * s.x, s.x * s.y, s.y * s.y).finished();
      left += s.weight * basis * basis.transpose();
      right += s.weight * basis * Eigen::RowVector3d(s.value.a, s.value.b, s.value.c);
    }
    const double total = left(0, 0);
    for (int r = 1; r < 6; ++r)
      left(r, r) +=
          (r < 3 ? thresholds::control_space::ridge_slope : thresholds::control_space::ridge_curvature) * total;
    const Eigen::Matrix<double, 6, 3> exact = left.ldlt().solve(right);
    const Metric2 value = fit.value_at_origin();
    EXPECT_NEAR(value.a, exact(0, 0), 1e-13);
    EXPECT_NEAR(value.b, exact(0, 1), 1e-13);
    EXPECT_NEAR(value.c, exact(0, 2), 1e-13);
  }
}

TEST(QuadraticFit, AConstantComesBackFromSamplesOnALine) {
  QuadraticFit fit;
  for (int k = -4; k <= 4; ++k) fit.add(0.1 * k, 0.2 * k, 1, {3, -1, 5});
  const Metric2 value = fit.value_at_origin();
  EXPECT_NEAR(value.a, 3, 1e-12);
  EXPECT_NEAR(value.b, -1, 1e-12);
  EXPECT_NEAR(value.c, 5, 1e-12);
}

}  // namespace
}  // namespace carreau::detail
