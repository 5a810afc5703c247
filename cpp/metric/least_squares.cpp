// SPDX-License-Identifier: BSD-3-Clause
#include "metric/least_squares.h"

#include <algorithm>
#include <cmath>

namespace carreau {

void LeastSquares::reset(std::size_t rows, std::size_t columns) {
  rows_ = rows, columns_ = columns;
  a_.assign(rows * columns, 0);
  pivot_.assign(columns, 0), scale_.assign(columns, 0), order_.resize(columns);
}

void LeastSquares::reflect(std::size_t k, double* column) const noexcept {
  const double* v = a_.data() + k * rows_;
  double along = 0;
  for (std::size_t i = k; i < rows_; ++i) along += v[i] * column[i];
  along *= scale_[k];
  for (std::size_t i = k; i < rows_; ++i) column[i] -= along * v[i];
}

bool LeastSquares::factorise(ColumnOrder order, double min_pivot) {
  double least = 0, most = 0;
  for (std::size_t k = 0; k < columns_; ++k) {
    std::size_t longest = k;
    double square = -1;
    for (std::size_t c = k; c < (order == ColumnOrder::given ? k + 1 : columns_); ++c) {
      double sum = 0;
      for (std::size_t i = k; i < rows_; ++i) sum += a_[c * rows_ + i] * a_[c * rows_ + i];
      if (sum > square) longest = c, square = sum;
    }
    order_[k] = longest;
    double* v = a_.data() + k * rows_;
    if (longest != k) std::swap_ranges(v, v + rows_, a_.data() + longest * rows_);
    const double length = std::sqrt(square);
    least = k == 0 ? length : std::min(least, length), most = std::max(most, length);
    if (!(length > 0)) return false;
    pivot_[k] = v[k] > 0 ? -length : length;
    v[k] -= pivot_[k];
    scale_[k] = -1 / (pivot_[k] * v[k]);
    for (std::size_t c = k + 1; c < columns_; ++c) reflect(k, a_.data() + c * rows_);
  }
  return least > min_pivot * most;
}

void LeastSquares::solve(std::span<double> right) const {
  for (std::size_t k = 0; k < columns_; ++k) reflect(k, right.data());
  for (std::size_t k = columns_; k-- > 0;) {
    for (std::size_t c = k + 1; c < columns_; ++c) right[k] -= a_[c * rows_ + k] * right[c];
    right[k] /= pivot_[k];
  }
  for (std::size_t k = columns_; k-- > 0;) std::swap(right[k], right[order_[k]]);
}

std::vector<double> inverse_of(std::span<const double> matrix, std::size_t n) {
  LeastSquares equations;
  equations.reset(n, n);
  for (std::size_t r = 0; r < n; ++r)
    for (std::size_t c = 0; c < n; ++c) equations.at(r, c) = matrix[r * n + c];
  std::vector<double> inverse(n * n), column(n);
  static_cast<void>(equations.factorise(ColumnOrder::longest_first, 0));
  for (std::size_t c = 0; c < n; ++c) {
    std::fill(column.begin(), column.end(), 0.0);
    column[c] = 1;
    equations.solve(column);
    for (std::size_t r = 0; r < n; ++r) inverse[r * n + c] = column[r];
  }
  return inverse;
}

}  // namespace carreau
