// SPDX-License-Identifier: BSD-3-Clause
// Small dense linear equations, by Householder reflections.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace carreau {

/// The order in which columns are eliminated.
enum class ColumnOrder { given, longest_first };

/// Equations a x = b with at least as many rows as columns: Golub and Van Loan, Matrix Computations, algorithms 5.2.1, 5.4.1.
/// Eigen gives the same solutions, and its templates cost each source that names one of them 8 s of a compiler.
class LeastSquares {
 public:
  /// Starts with a matrix of zeros.
  void reset(std::size_t rows, std::size_t columns);
  [[nodiscard]] double& at(std::size_t row, std::size_t column) noexcept { return a_[column * rows_ + row]; }
  /// Overwrites the matrix by its factors. Returns false if a pivot is not above `min_pivot` of the largest pivot.
  [[nodiscard]] bool factorise(ColumnOrder order, double min_pivot);
  /// Writes the solution into the first entries of `right`, which holds a number for each row. Requires the factors.
  void solve(std::span<double> right) const;

 private:
  void reflect(std::size_t k, double* column) const noexcept;

  std::size_t rows_ = 0, columns_ = 0;
  std::vector<double> a_, pivot_, scale_;
  std::vector<std::size_t> order_;
};

/// The inverse of a square matrix of n rows, by rows. Requires a regular matrix.
std::vector<double> inverse_of(std::span<const double> matrix, std::size_t n);

}  // namespace carreau
