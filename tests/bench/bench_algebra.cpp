// SPDX-License-Identifier: BSD-3-Clause
// Time of our algebra against Eigen's for the same: "bench_algebra". Functions that are not faster here are kept for their accuracy
// (tests/cpp/metric/eigen_comparison_test.cpp).
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <random>
#include <vector>

#include "control_space/quadratic_fit.h"
#include "metric/metric3_algebra.h"

namespace {

using namespace carreau;

constexpr int count = 2000, runs = 40;

/// Nanoseconds of the processor for one of `count` calls, the best of all runs; keeps the result of f alive.
template <typename F>
double nanoseconds(const F& f) {
  static volatile double sink = 0;
  double best = 1e300, sum = 0;
  for (int run = 0; run < runs; ++run) {
    const std::clock_t start = std::clock();
    for (int repeat = 0; repeat < 10; ++repeat)
      for (int i = 0; i < count; ++i) sum += f(i);
    best = std::min(best, 1e8 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / count);
  }
  sink = sink + sum;
  return best;
}

template <typename Ours, typename Theirs>
void compare(const char* what, const Ours& ours, const Theirs& theirs) {
  const double a = nanoseconds(ours), b = nanoseconds(theirs);
  std::printf("%-46s %8.1f ns, Eigen %8.1f ns, %5.2f times\n", what, a, b, b / a);
}

Eigen::Matrix2d matrix(Metric2 m) { return (Eigen::Matrix2d() << m.a, m.b, m.b, m.c).finished(); }
Eigen::Matrix3d matrix(const Metric3& m) {
  return (Eigen::Matrix3d() << m.xx, m.xy, m.xz, m.xy, m.yy, m.yz, m.xz, m.yz, m.zz).finished();
}

struct Sample {
  double x, y, weight;
  Metric2 value;
};

/// The same equations in Eigen's matrices.
struct EigenFit {
  using Matrix = Eigen::Matrix<double, 6, 6>;
  using Vector = Eigen::Matrix<double, 6, 1>;
  Matrix left = Matrix::Zero();
  Eigen::Matrix<double, 6, 3> right = Eigen::Matrix<double, 6, 3>::Zero();
  void add(const Sample& s) {
    const Vector basis = (Vector() << 1, s.x, s.y, s.x * s.x, s.x * s.y, s.y * s.y).finished(), w = s.weight * basis;
    left.noalias() += w * basis.transpose();
    right.col(0) += s.value.a * w, right.col(1) += s.value.b * w, right.col(2) += s.value.c * w;
  }
  double value() {
    const double total = left(0, 0);
    for (int r = 1; r < 6; ++r)
      left(r, r) +=
          (r < 3 ? thresholds::control_space::ridge_slope : thresholds::control_space::ridge_curvature) * total;
    return left.llt().solve(right)(0, 0);
  }
};

void planes(const std::vector<Metric2>& m) {
  compare(
      "eigenvalues and vectors, plane", [&](int i) { return eigen(m[i]).minor; },
      [&](int i) {
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> s(matrix(m[i]));
        return s.eigenvalues()[0] + s.eigenvectors()(0, 0);
      });
  compare(
      "square root, plane", [&](int i) { return square_root(m[i]).a; },
      [&](int i) { return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(matrix(m[i])).operatorSqrt()(0, 0); });
  compare(
      "ratios of lengths, plane", [&](int i) { return length_ratios(m[i], m[count - 1 - i]).largest; },
      [&](int i) {
        return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d>(matrix(m[i]), matrix(m[count - 1 - i]),
                                                                         Eigen::EigenvaluesOnly)
            .eigenvalues()[1];
      });
}

void spaces(const std::vector<Metric3>& m) {
  compare(
      "eigenvalues and vectors, space", [&](int i) { return eigen(m[i]).value[2]; },
      [&](int i) {
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> s(matrix(m[i]));
        return s.eigenvalues()[0] + s.eigenvectors()(0, 0);
      });
  compare(
      "simultaneous reduction, space", [&](int i) { return reduce(m[i], m[count - 1 - i]).ratio[0]; },
      [&](int i) {
        const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d> s(matrix(m[i]), matrix(m[count - 1 - i]));
        return s.eigenvalues()[2] + s.eigenvectors()(0, 0);
      });
}

void fits(const std::vector<Sample>& samples) {
  constexpr int around = 48;  // neighbours of a node at the border
  compare(
      "quadratic fit of 48 samples",
      [&](int i) {
        detail::QuadraticFit fit;
        for (int k = 0; k < around; ++k) {
          const Sample& s = samples[(i + k) % count];
          fit.add(s.x, s.y, s.weight, s.value);
        }
        return fit.value_at_origin().a;
      },
      [&](int i) {
        EigenFit fit;
        for (int k = 0; k < around; ++k) fit.add(samples[(i + k) % count]);
        return fit.value();
      });
}

}  // namespace

int main() {
  std::mt19937_64 engine{1};
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<Metric2> plane;
  std::vector<Metric3> space;
  std::vector<Sample> samples;
  for (int i = 0; i < count; ++i) {
    plane.push_back({2 + unit(engine), unit(engine), 2 + unit(engine)});
    space.push_back({3 + unit(engine), unit(engine), unit(engine), 3 + unit(engine), unit(engine), 3 + unit(engine)});
    samples.push_back({unit(engine), unit(engine), 1.5 + unit(engine), plane.back()});
  }
  planes(plane);
  spaces(space);
  fits(samples);
}
