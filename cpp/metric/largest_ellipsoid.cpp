// SPDX-License-Identifier: BSD-3-Clause
#include "metric/largest_ellipsoid.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

namespace carreau {

namespace {

template <int D>
using Matrix = Eigen::Matrix<double, D, D>;

Matrix<2> matrix_of(Metric2 m) { return Matrix<2>{{m.a, m.b}, {m.b, m.c}}; }
Matrix<3> matrix_of(const Metric3& m) { return Matrix<3>{{m.xx, m.xy, m.xz}, {m.xy, m.yy, m.yz}, {m.xz, m.yz, m.zz}}; }
void set(Metric2& m, const Matrix<2>& a) { m = {a(0, 0), a(0, 1), a(1, 1)}; }
void set(Metric3& m, const Matrix<3>& a) { m = {a(0, 0), a(0, 1), a(0, 2), a(1, 1), a(1, 2), a(2, 2)}; }
bool precedes(Metric2 p, Metric2 q) { return std::tie(p.a, p.b, p.c) < std::tie(q.a, q.b, q.c); }
bool precedes(const Metric3& p, const Metric3& q) {
  return std::tie(p.xx, p.xy, p.xz, p.yy, p.yz, p.zz) < std::tie(q.xx, q.xy, q.xz, q.yy, q.yz, q.zz);
}

/// Symmetric matrices with one pair of entries.
template <int D>
std::vector<Matrix<D>> basis() {
  std::vector<Matrix<D>> all;
  for (int i = 0; i < D; ++i)
    for (int j = i; j < D; ++j) {
      Matrix<D> e = Matrix<D>::Zero();
      e(i, j) = e(j, i) = 1;
      all.push_back(e);
    }
  return all;
}

/// Maximises log det P under I - R_i P R_i^T > 0, where P is the inverse of the metric sought and R_i^T R_i = M_i, in
/// coordinates in which the unit ball is inside. Follows a path of barriers, each by Newton's method.
template <int D>
class LargestInside {
 public:
  explicit LargestInside(std::vector<Matrix<D>> roots) : roots_(std::move(roots)) {}

  Matrix<D> solve() {
    p_ = 0.5 * Matrix<D>::Identity();
    for (double weight = 1; weight > min_weight; weight *= 0.2) {
      for (int step = 0; step < max_steps && newton(weight) > enough; ++step) {
      }
    }
    return p_;
  }

 private:
  static constexpr double min_weight = 1e-10, enough = 1e-6;
  static constexpr int max_steps = 50, max_halvings = 40;
  static constexpr int size = D * (D + 1) / 2;

  /// The function to be least; infinity outside.
  [[nodiscard]] double value(const Matrix<D>& p, double weight) const {
    const auto log_det = [](const Matrix<D>& m) {
      const Eigen::LLT<Matrix<D>> factor(m);
      if (factor.info() != Eigen::Success) return -std::numeric_limits<double>::infinity();
      const Matrix<D> l = factor.matrixL();
      return 2 * l.diagonal().array().log().sum();
    };
    double sum = -log_det(p);
    for (const Matrix<D>& r : roots_) sum -= weight * log_det(Matrix<D>::Identity() - r * p * r.transpose());
    return sum;
  }

  /// One step; the decrement of Newton's method, squared, over the weight.
  double newton(double weight) {
    static const std::vector<Matrix<D>> directions = basis<D>();
    const Matrix<D> inverse = p_.inverse();
    std::vector<std::pair<double, Matrix<D>>> terms{{-1, inverse}};
    for (const Matrix<D>& r : roots_)
      terms.emplace_back(weight, r.transpose() * (Matrix<D>::Identity() - r * p_ * r.transpose()).inverse() * r);
    Eigen::Matrix<double, size, 1> gradient = Eigen::Matrix<double, size, 1>::Zero();
    Eigen::Matrix<double, size, size> hessian = Eigen::Matrix<double, size, size>::Zero();
    for (const auto& [sign, g] : terms)
      for (int i = 0; i < size; ++i) {
        const Matrix<D> turned = g * directions[i] * g;
        gradient(i) += sign * (g * directions[i]).trace();
        for (int j = 0; j < size; ++j) hessian(i, j) += std::abs(sign) * (turned * directions[j]).trace();
      }
    const Eigen::Matrix<double, size, 1> step = hessian.ldlt().solve(-gradient);
    const double decrement = -gradient.dot(step);
    if (!(decrement > 0)) return 0;
    Matrix<D> way = Matrix<D>::Zero();
    for (int i = 0; i < size; ++i) way += step(i) * directions[i];
    const double here = value(p_, weight);
    double share = 1;
    for (int halving = 0; halving < max_halvings; ++halving, share *= 0.5) {
      const Matrix<D> next = p_ + share * way;
      if (!(value(next, weight) < here)) continue;
      p_ = next;
      return decrement / weight;
    }
    return 0;  // rounding
  }

  std::vector<Matrix<D>> roots_;
  Matrix<D> p_;
};

template <int D, typename Metric>
Metric largest_of(std::span<const Metric> given) {
  std::vector<Metric> metrics(given.begin(), given.end());
  std::sort(metrics.begin(), metrics.end(), [](const Metric& p, const Metric& q) { return precedes(p, q); });
  metrics.erase(std::unique(metrics.begin(), metrics.end()), metrics.end());
  const Metric inside = intersection(std::span<const Metric>(metrics));
  if (metrics.size() < 3) return inside;
  // Coordinates in which that one is the unit ball.
  const Eigen::LLT<Matrix<D>> frame(matrix_of(inside));
  std::vector<Matrix<D>> roots;
  for (const Metric& m : metrics) {
    const Eigen::LLT<Matrix<D>> factor(matrix_of(m));
    const Matrix<D> upper = factor.matrixU();
    roots.push_back(frame.matrixU().template solve<Eigen::OnTheRight>(upper));
  }
  const Matrix<D> p = LargestInside<D>(std::move(roots)).solve();
  const Matrix<D> lower = frame.matrixL();
  Metric result;
  set(result, Matrix<D>(lower * p.inverse() * lower.transpose()));
  return result;
}

}  // namespace

Metric2 largest_inside(std::span<const Metric2> metrics) { return largest_of<2>(metrics); }
Metric3 largest_inside(std::span<const Metric3> metrics) { return largest_of<3>(metrics); }

}  // namespace carreau
