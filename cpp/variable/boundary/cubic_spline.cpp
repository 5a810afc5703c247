// SPDX-License-Identifier: BSD-3-Clause
#include "variable/boundary/cubic_spline.h"

#include <algorithm>
#include <cmath>

namespace carreau::variable {

namespace {

/// Derivative at x[at] of the polynomial through n points.
Vec2 polynomial_derivative(std::span<const double> x, std::span<const Vec2> y, std::size_t at) {
  Vec2 sum{0, 0};
  for (std::size_t i = 0; i < x.size(); ++i) {
    double weight = 0;  // of the Lagrange polynomial i
    if (i == at) {
      for (std::size_t j = 0; j < x.size(); ++j)
        if (j != at) weight += 1 / (x[at] - x[j]);
    } else {
      weight = 1 / (x[i] - x[at]);
      for (std::size_t j = 0; j < x.size(); ++j)
        if (j != i && j != at) weight *= (x[at] - x[j]) / (x[i] - x[j]);
    }
    sum += weight * y[i];
  }
  return sum;
}

/// Tangent at the first of some points by the first four of them, or as many as there are.
Vec2 end_tangent(std::span<const Vec2> points, std::span<const double> width) {
  const std::size_t n = std::min<std::size_t>(4, points.size());
  std::vector<double> x{0};
  for (std::size_t i = 0; i + 1 < n; ++i) x.push_back(x.back() + width[i]);
  return polynomial_derivative(x, points.first(n), 0);
}

/// A tridiagonal system that is dominated by its diagonal, for right sides of two numbers. `below[i]` and `above[i]`
/// stand beside `diagonal[i]`. Overwrites the diagonal; the solution takes the place of `right`.
void solve_tridiagonal(const std::vector<double>& below, std::vector<double>& diagonal,
                       const std::vector<double>& above, std::vector<Vec2>& right) {
  const std::size_t n = diagonal.size();
  for (std::size_t i = 1; i < n; ++i) {
    const double factor = below[i] / diagonal[i - 1];
    diagonal[i] -= factor * above[i - 1];
    right[i] -= factor * right[i - 1];
  }
  right[n - 1] /= diagonal[n - 1];
  for (std::size_t i = n - 1; i-- > 0;) right[i] = (right[i] - above[i] * right[i + 1]) / diagonal[i];
}

}  // namespace

CubicSpline::CubicSpline(std::span<const Vec2> points, SplineEnds ends) : points_(points.begin(), points.end()) {
  const std::size_t pieces = points_.size() - (ends == SplineEnds::periodic ? 0 : 1);
  for (std::size_t i = 0; i < pieces; ++i) width_.push_back(norm(end(i) - points_[i]));
  if (ends == SplineEnds::periodic)
    solve_periodic();
  else
    solve_open(points_.size() == 2 ? SplineEnds::natural : ends);
}

Vec2 CubicSpline::slope_of(std::size_t piece) const noexcept { return (end(piece) - points_[piece]) / width_[piece]; }

void CubicSpline::solve_open(SplineEnds ends) {
  const std::size_t n = points_.size(), last = n - 1;
  std::vector<double> below(n, 0), diagonal(n, 1), above(n, 0);
  moments_.assign(n, Vec2{0, 0});
  for (std::size_t i = 1; i < last; ++i) {
    below[i] = width_[i - 1], above[i] = width_[i], diagonal[i] = 2 * (width_[i - 1] + width_[i]);
    moments_[i] = 6 * (slope_of(i) - slope_of(i - 1));
  }
  if (ends == SplineEnds::tangent) {
    std::vector<Vec2> reversed(points_.rbegin(), points_.rend());
    std::vector<double> widths(width_.rbegin(), width_.rend());
    const Vec2 first = end_tangent(points_, width_), final = -end_tangent(reversed, widths);
    diagonal[0] = 2 * width_[0], above[0] = width_[0];
    moments_[0] = 6 * (slope_of(0) - first);
    diagonal[last] = 2 * width_[last - 1], below[last] = width_[last - 1];
    moments_[last] = 6 * (final - slope_of(last - 1));
  }
  solve_tridiagonal(below, diagonal, above, moments_);
}

// The corners of the cyclic matrix are split off as a product of two vectors (Sherman and Morrison).
void CubicSpline::solve_periodic() {
  const std::size_t n = points_.size(), last = n - 1;
  std::vector<double> below(n), diagonal(n), above(n);
  moments_.assign(n, Vec2{0, 0});
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = (i + last) % n;
    below[i] = width_[before], above[i] = width_[i], diagonal[i] = 2 * (width_[before] + width_[i]);
    moments_[i] = 6 * (slope_of(i) - slope_of(before));
  }
  const double corner = width_[last], gamma = -diagonal[0];
  diagonal[0] -= gamma, diagonal[last] -= corner * corner / gamma;
  std::vector<Vec2> column(n, Vec2{0, 0});  // its first coordinate only
  column[0].x() = gamma, column[last].x() = corner;
  std::vector<double> again = diagonal;
  solve_tridiagonal(below, diagonal, above, moments_);
  solve_tridiagonal(below, again, above, column);
  const double share = corner / gamma, bottom = 1 + column[0].x() + share * column[last].x();
  const Vec2 factor = (moments_[0] + share * moments_[last]) / bottom;
  for (std::size_t i = 0; i < n; ++i) moments_[i] -= column[i].x() * factor;
}

Vec2 CubicSpline::at(std::size_t piece, double t) const noexcept {
  const double u = 1 - t, w = width_[piece] * width_[piece] / 6;
  const Vec2 &m = moments_[piece], &n = moments_[(piece + 1) % moments_.size()];
  return u * points_[piece] + t * end(piece) + w * ((u * u * u - u) * m + (t * t * t - t) * n);
}

Vec2 CubicSpline::derivative(std::size_t piece, double t) const noexcept {
  const double u = 1 - t, w = width_[piece] / 6;
  const Vec2 &m = moments_[piece], &n = moments_[(piece + 1) % moments_.size()];
  return slope_of(piece) + w * ((3 * t * t - 1) * n - (3 * u * u - 1) * m);
}

Vec2 CubicSpline::second_derivative(std::size_t piece, double t) const noexcept {
  return lerp(moments_[piece], moments_[(piece + 1) % moments_.size()], t);
}

double CubicSpline::curvature(std::size_t piece, double t) const noexcept {
  const Vec2 d = derivative(piece, t);
  const double speed = norm(d);
  return speed > 0 ? std::abs(cross(d, second_derivative(piece, t))) / (speed * speed * speed) : 0;
}

}  // namespace carreau::variable
