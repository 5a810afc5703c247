// SPDX-License-Identifier: BSD-3-Clause
// One step of least squares on the coefficients of several primitives.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "geometry/atlas/primitive.h"

namespace carreau::atlas {

/// Coefficients of one primitive.
using Block = Eigen::Matrix<double, Primitive::terms, 3>;
using Blocks = std::vector<Block>;
using Gram = Eigen::Matrix<double, Primitive::terms, Primitive::terms>;

/// A residual of up to three primitives: the missing Jacobian, and its derivatives by their coefficients.
struct MendRow {
  double missing = 0;
  std::array<std::size_t, 3> rank{};  ///< of the primitives
  std::array<Block, 3> gradient;
  std::size_t count = 0;
};

/// Sum of products of all coefficients, from first to last.
double product(const Block& a, const Block& b);

/// x with (A + sum of g g^T over rows) x = right, A being the blocks weight[r] * gram[r]: conjugate gradients,
/// preconditioned by A.
Blocks solve_step(const std::vector<Gram>& gram, const std::vector<double>& weight, const std::vector<MendRow>& rows,
                  const Blocks& right);

}  // namespace carreau::atlas
