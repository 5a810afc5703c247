// SPDX-License-Identifier: BSD-3-Clause
// Matrices of three rows are plain arrays: Eigen's decompositions of them took ten times as long to compile as the file.
#include "metric/largest_ellipsoid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

namespace carreau {

namespace {

constexpr int terms = 6;  // of a symmetric matrix
using Matrix = std::array<std::array<double, 3>, 3>;
constexpr Matrix identity{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr int row_of[terms] = {0, 0, 0, 1, 1, 2}, column_of[terms] = {0, 1, 2, 1, 2, 2};

Matrix matrix_of(const Metric3& m) { return {{{m.xx, m.xy, m.xz}, {m.xy, m.yy, m.yz}, {m.xz, m.yz, m.zz}}}; }
bool precedes(const Metric3& p, const Metric3& q) {
  return std::tie(p.xx, p.xy, p.xz, p.yy, p.yz, p.zz) < std::tie(q.xx, q.xy, q.xz, q.yy, q.yz, q.zz);
}

/// p + w q
Matrix sum(const Matrix& p, double w, const Matrix& q) {
  Matrix r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r[i][j] = p[i][j] + w * q[i][j];
  return r;
}

Matrix product(const Matrix& p, const Matrix& q) {
  Matrix r{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) r[i][j] += p[i][k] * q[k][j];
  return r;
}

Matrix transposed(const Matrix& p) {
  Matrix r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r[i][j] = p[j][i];
  return r;
}

/// Symmetric matrix with one pair of entries.
Matrix direction(int k) {
  Matrix e{};
  e[row_of[k]][column_of[k]] = e[column_of[k]][row_of[k]] = 1;
  return e;
}

/// Cholesky: lower triangle L, L L^T = m; false if m is not positive definite.
template <std::size_t n>
bool factor(std::array<std::array<double, n>, n>& m) {
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = j; i < n; ++i) {
      double rest = m[i][j];
      for (std::size_t k = 0; k < j; ++k) rest -= m[i][k] * m[j][k];
      if (i == j && !(rest > 0)) return false;
      m[i][j] = i == j ? std::sqrt(rest) : rest / m[j][j];
    }
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < j; ++i) m[i][j] = 0;
  return true;
}

/// L^-1 b, and with `both` (L L^T)^-1 b.
template <std::size_t n>
void solve(const std::array<std::array<double, n>, n>& lower, std::array<double, n>& b, bool both) {
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) b[i] -= lower[i][k] * b[k];
    b[i] /= lower[i][i];
  }
  for (std::size_t i = n; both && i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) b[i] -= lower[k][i] * b[k];
    b[i] /= lower[i][i];
  }
}

/// Inverse of a positive definite matrix, which is symmetric.
Matrix inverse_of(Matrix m) {
  factor(m);
  Matrix r = identity;
  for (auto& row : r) solve(m, row, true);
  return r;
}

double log_determinant(Matrix m) {
  if (!factor(m)) return -std::numeric_limits<double>::infinity();
  return 2 * (std::log(m[0][0]) + std::log(m[1][1]) + std::log(m[2][2]));
}

/// Maximises log det P under I - R_i P R_i^T > 0, where P is the inverse of the metric sought and R_i^T R_i = M_i, in
/// coordinates in which the unit ball is inside. Follows a path of barriers, each by Newton's method.
class LargestInside {
 public:
  explicit LargestInside(std::vector<Matrix> roots) : roots_(std::move(roots)) {}

  Matrix solve_for_inverse() {
    p_ = sum({}, 0.5, identity);
    for (double weight = 1; weight > min_weight; weight *= 0.2) {
      for (int step = 0; step < max_steps && newton(weight) > enough; ++step) {
      }
    }
    return p_;
  }

 private:
  static constexpr double min_weight = 1e-10, enough = 1e-6;
  static constexpr int max_steps = 50, max_halvings = 40;

  static Matrix room(const Matrix& r, const Matrix& p) { return sum(identity, -1, product(product(r, p), transposed(r))); }

  /// The function to be least; infinity outside.
  [[nodiscard]] double value(const Matrix& p, double weight) const {
    double all = -log_determinant(p);
    for (const Matrix& r : roots_) all -= weight * log_determinant(room(r, p));
    return all;
  }

  /// One step; the decrement of Newton's method, squared, over the weight.
  double newton(double weight) {
    std::vector<std::pair<double, Matrix>> parts{{-1, inverse_of(p_)}};
    for (const Matrix& r : roots_) parts.emplace_back(weight, product(product(transposed(r), inverse_of(room(r, p_))), r));
    std::array<double, terms> gradient{};
    std::array<std::array<double, terms>, terms> hessian{};
    for (const auto& [sign, g] : parts)
      for (int i = 0; i < terms; ++i) {
        const Matrix once = product(g, direction(i)), turned = product(once, g);
        gradient[i] += sign * (once[0][0] + once[1][1] + once[2][2]);
        for (int j = 0; j < terms; ++j) {
          const int r = row_of[j], c = column_of[j];
          hessian[i][j] += std::abs(sign) * (r == c ? turned[r][r] : turned[r][c] + turned[c][r]);
        }
      }
    std::array<double, terms> step;
    for (int i = 0; i < terms; ++i) step[i] = -gradient[i];
    if (!factor(hessian)) return 0;  // rounding
    solve(hessian, step, true);
    double decrement = 0;
    Matrix way{};
    for (int i = 0; i < terms; ++i) decrement -= gradient[i] * step[i], way = sum(way, step[i], direction(i));
    if (!(decrement > 0)) return 0;
    const double here = value(p_, weight);
    double share = 1;
    for (int halving = 0; halving < max_halvings; ++halving, share *= 0.5) {
      const Matrix next = sum(p_, share, way);
      if (!(value(next, weight) < here)) continue;
      p_ = next;
      return decrement / weight;
    }
    return 0;  // rounding
  }

  std::vector<Matrix> roots_;
  Matrix p_{};
};

}  // namespace

Metric3 largest_inside(std::span<const Metric3> given) {
  std::vector<Metric3> metrics(given.begin(), given.end());
  std::sort(metrics.begin(), metrics.end(), precedes);
  metrics.erase(std::unique(metrics.begin(), metrics.end()), metrics.end());
  const Metric3 inside = intersection(std::span<const Metric3>(metrics));
  if (metrics.size() < 3) return inside;
  // Coordinates in which that one is the unit ball: M becomes F^-1 M F^-T, and its root L^T F^-T.
  Matrix frame = matrix_of(inside);
  factor(frame);
  std::vector<Matrix> roots;
  for (const Metric3& m : metrics) {
    Matrix root = matrix_of(m);
    factor(root);
    root = transposed(root);
    for (auto& row : root) solve(frame, row, false);
    roots.push_back(root);
  }
  const Matrix p = LargestInside(std::move(roots)).solve_for_inverse();
  const Matrix r = product(product(frame, inverse_of(p)), transposed(frame));
  return {r[0][0], r[0][1], r[0][2], r[1][1], r[1][2], r[2][2]};
}

// In space, where all metrics have the length 1 across the plane.
Metric2 largest_inside(std::span<const Metric2> metrics) {
  std::vector<Metric3> in_space;
  for (const Metric2& m : metrics) in_space.push_back({m.a, m.b, 0, m.c, 0, 1});
  std::sort(in_space.begin(), in_space.end(), precedes);
  in_space.erase(std::unique(in_space.begin(), in_space.end()), in_space.end());
  if (in_space.size() < 3) {
    const Metric3 &p = in_space.front(), &q = in_space.back();
    const Metric2 first{p.xx, p.xy, p.yy}, last{q.xx, q.xy, q.yy};
    return first == last ? first : intersection(first, last);
  }
  const Metric3 m = largest_inside(in_space);
  return {m.xx, m.xy, m.yy};
}

}  // namespace carreau
