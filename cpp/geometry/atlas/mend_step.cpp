// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/atlas/mend_step.h"

#include <Eigen/Cholesky>

namespace carreau::atlas {
namespace {

double product(const Blocks& a, const Blocks& b) {
  double sum = 0;
  for (std::size_t r = 0; r < a.size(); ++r) sum += carreau::atlas::product(a[r], b[r]);
  return sum;
}

class Step {
 public:
  Step(const std::vector<Gram>& gram, const std::vector<double>& weight, const std::vector<MendRow>& rows)
      : rows_(rows) {
    for (std::size_t r = 0; r < gram.size(); ++r)
      matrix_.emplace_back(weight[r] * gram[r]), inverse_.emplace_back(matrix_.back());
  }

  [[nodiscard]] Blocks solve(const Blocks& right) const {
    constexpr int max_steps = 200;
    constexpr double enough = 1e-8;  // of the square of the residual
    Blocks x(right.size(), Block::Zero()), residual = right, z = conditioned(residual), p = z;
    double now = product(residual, z);
    const double last = enough * now;
    for (int k = 0; k < max_steps && now > last; ++k) {
      const Blocks image = apply(p);
      const double share = now / product(p, image);
      for (std::size_t r = 0; r < x.size(); ++r) x[r] += share * p[r], residual[r] -= share * image[r];
      z = conditioned(residual);
      const double then = product(residual, z);
      for (std::size_t r = 0; r < x.size(); ++r) p[r] = z[r] + then / now * p[r];
      now = then;
    }
    return x;
  }

 private:
  [[nodiscard]] Blocks conditioned(const Blocks& x) const {
    Blocks y;
    for (std::size_t r = 0; r < x.size(); ++r) y.emplace_back(inverse_[r].solve(x[r]));
    return y;
  }
  [[nodiscard]] Blocks apply(const Blocks& x) const {
    Blocks y;
    for (std::size_t r = 0; r < x.size(); ++r) y.emplace_back(matrix_[r] * x[r]);
    for (const MendRow& row : rows_) {
      double along = 0;
      for (std::size_t c = 0; c < row.count; ++c) along += carreau::atlas::product(row.gradient[c], x[row.rank[c]]);
      for (std::size_t c = 0; c < row.count; ++c) y[row.rank[c]] += along * row.gradient[c];
    }
    return y;
  }

  const std::vector<MendRow>& rows_;
  std::vector<Gram> matrix_;
  std::vector<Eigen::LDLT<Gram>> inverse_;
};

}  // namespace

double product(const Block& a, const Block& b) {
  double sum = 0;
  for (int k = 0; k < Primitive::terms; ++k)
    for (int d = 0; d < 3; ++d) sum += a(k, d) * b(k, d);
  return sum;
}

Blocks solve_step(const std::vector<Gram>& gram, const std::vector<double>& weight, const std::vector<MendRow>& rows,
                  const Blocks& right) {
  return Step(gram, weight, rows).solve(right);
}

}  // namespace carreau::atlas
