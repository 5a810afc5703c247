// SPDX-License-Identifier: BSD-3-Clause
// The value at the origin of the quadratic polynomial that fits samples best.
#pragma once

#include <array>
#include <cstddef>

#include "control_space/thresholds.h"
#include "metric/metric2.h"

namespace carreau::detail {

/// Normal equations of a weighted fit by 1, x, y, x^2, x y, y^2, three right-hand sides. Only the constant term is
/// needed: an elimination that ends there is faster than Eigen's factors and solutions (`bench_algebra`).
class QuadraticFit {
 public:
  void add(double x, double y, double weight, Metric2 value) noexcept {
    const std::array<double, terms> basis{1, x, y, x * x, x * y, y * y};
    for (std::size_t r = 0; r < terms; ++r) {
      const double w = weight * basis[r];
      for (std::size_t c = 0; c <= r; ++c) matrix_[r][c] += w * basis[c];
      right_[r][0] += w * value.a;
      right_[r][1] += w * value.b;
      right_[r][2] += w * value.c;
    }
  }

  /// Cholesky, U^T U of the reversed order; it overwrites the equations, so it may be called once only.
  Metric2 value_at_origin() noexcept {
    const double total = matrix_[0][0];
    for (std::size_t r = 1; r < terms; ++r)
      matrix_[r][r] +=
          (r < 3 ? thresholds::control_space::ridge_slope : thresholds::control_space::ridge_curvature) * total;
    for (std::size_t r = terms - 1; r > 0; --r) {
      const double pivot = 1 / matrix_[r][r];
      for (std::size_t i = 0; i < r; ++i) {
        const double factor = matrix_[r][i] * pivot;
        for (std::size_t c = 0; c <= i; ++c) matrix_[i][c] -= factor * matrix_[r][c];
        for (std::size_t k = 0; k < 3; ++k) right_[i][k] -= factor * right_[r][k];
      }
    }
    const double inverse = 1 / matrix_[0][0];
    return {inverse * right_[0][0], inverse * right_[0][1], inverse * right_[0][2]};
  }

  static constexpr std::size_t terms = 6;

 private:
  std::array<std::array<double, terms>, terms> matrix_{};
  std::array<std::array<double, 3>, terms> right_{};
};

}  // namespace carreau::detail
