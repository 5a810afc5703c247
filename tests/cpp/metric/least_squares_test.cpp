// SPDX-License-Identifier: BSD-3-Clause
#include "metric/least_squares.h"

#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>

#include "support/vec.h"

namespace carreau {
namespace {

/// Rows 1, t, t^2 and t^3 at `rows` places t of [0, 1].
LeastSquares cubic(std::size_t rows) {
  LeastSquares equations;
  equations.reset(rows, 4);
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < 4; ++c) equations.at(r, c) = std::pow(static_cast<double>(r) / static_cast<double>(rows - 1), static_cast<double>(c));
  return equations;
}

TEST(LeastSquares, IsExactOnPolynomialsInBothOrders) {
  for (const ColumnOrder order : {ColumnOrder::given, ColumnOrder::longest_first})
    for (const std::size_t rows : {std::size_t{4}, std::size_t{9}}) {
      LeastSquares equations = cubic(rows);
      const std::vector<double> exact{2, -3, 0.5, 7};
      std::vector<double> right(rows, 0);
      for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t c = 0; c < 4; ++c) right[r] += equations.at(r, c) * exact[c];
      ASSERT_TRUE(equations.factorise(order, 1e-6));
      equations.solve(right);
      for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(right[c], exact[c], 1e-12);
    }
}

TEST(LeastSquares, LeavesAResidualOrthogonalToTheColumns) {
  LeastSquares equations = cubic(12);
  LeastSquares kept = equations;
  std::vector<double> right(12);
  for (std::size_t r = 0; r < 12; ++r) right[r] = std::exp(0.3 * static_cast<double>(r));
  std::vector<double> x = right;
  ASSERT_TRUE(equations.factorise(ColumnOrder::longest_first, 1e-6));
  equations.solve(x);
  for (std::size_t c = 0; c < 4; ++c) {
    double along = 0;
    for (std::size_t r = 0; r < 12; ++r) {
      double residual = right[r];
      for (std::size_t k = 0; k < 4; ++k) residual -= kept.at(r, k) * x[k];
      along += residual * kept.at(r, c);
    }
    EXPECT_NEAR(along, 0, 1e-11);
  }
}

TEST(LeastSquares, ReportsDependentColumns) {
  for (const ColumnOrder order : {ColumnOrder::given, ColumnOrder::longest_first}) {
    LeastSquares equations;
    equations.reset(5, 3);
    for (std::size_t r = 0; r < 5; ++r) equations.at(r, 0) = 1, equations.at(r, 1) = static_cast<double>(r), equations.at(r, 2) = 3 - 2 * static_cast<double>(r);
    EXPECT_FALSE(equations.factorise(order, 1e-9));
    equations.reset(3, 2);
    EXPECT_FALSE(equations.factorise(order, 0));  // zeros
  }
}

TEST(LeastSquares, InvertsTheHilbertMatrix) {
  // Savage and Lukacs 1954: the inverse has whole numbers.
  const std::vector<double> inverse = inverse_of(
      std::vector<double>{1, 1. / 2, 1. / 3, 1. / 4, 1. / 2, 1. / 3, 1. / 4, 1. / 5, 1. / 3, 1. / 4, 1. / 5, 1. / 6, 1. / 4, 1. / 5, 1. / 6, 1. / 7}, 4);
  const double exact[] = {16, -120, 240, -140, -120, 1200, -2700, 1680, 240, -2700, 6480, -4200, -140, 1680, -4200, 2800};
  for (std::size_t i = 0; i < 16; ++i) EXPECT_NEAR(inverse[i], exact[i], 1e-8);
}

TEST(Points, HaveSumsAndMultiplesThatArePoints) {
  const Vec3 p(1, 2, 3), q(0.5, 0.25, 0.125);
  static_assert(std::is_same_v<decltype(p + q), Vec3> && std::is_same_v<decltype(2 * p - q / 2), Vec3>);
  static_assert(std::is_same_v<decltype(-Vec2(1, 2) * 3), Vec2>);
  EXPECT_EQ(2 * p - q / 2, Vec3(1.75, 3.875, 5.9375));
  EXPECT_EQ(-Vec2(1, 2) * 3 + Vec2(1, 1), Vec2(-2, -5));
  EXPECT_EQ(p + p.cwiseProduct(q), Vec3(1.5, 2.5, 3.375));  // with an expression of Eigen
}

}  // namespace
}  // namespace carreau
