// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/elements/jacobian.h"

#include <algorithm>
#include <cmath>

#include "support/infinity.h"

namespace carreau {

namespace {

// Control point of a quadratic Bezier segment through m at its middle.
Vec3 control(const Vec3& a, const Vec3& m, const Vec3& b) noexcept { return 2 * m - 0.5 * (a + b); }

Jacobian of_triangle6(std::span<const Vec3> x) noexcept {
  const Vec3 ab = control(x[0], x[3], x[1]), bc = control(x[1], x[4], x[2]), ca = control(x[2], x[5], x[0]);
  // Derivatives are of degree 1: their values at the three corners.
  const std::array<Vec3, 3> s{2 * (ab - x[0]), 2 * (x[1] - ab), 2 * (bc - ca)},
      t{2 * (ca - x[0]), 2 * (bc - ab), 2 * (x[2] - ca)};
  Jacobian j;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t k = (i + 1) % 3;
    j.c[i] = cross(s[i], t[i]);
    j.c[3 + i] = 0.5 * (cross(s[i], t[k]) + cross(s[k], t[i]));
  }
  j.count = 6;
  return j;
}

Jacobian of_quad4(std::span<const Vec3> x) noexcept {
  Jacobian j;
  const Vec3 s0 = x[1] - x[0], s1 = x[2] - x[3], t0 = x[3] - x[0], t1 = x[2] - x[1];
  j.c[0] = cross(s0, t0), j.c[1] = cross(s0, t1), j.c[2] = cross(s1, t1), j.c[3] = cross(s1, t0);
  j.count = 4;
  return j;
}

/// b[i][k]: control points of degree (2, 2), of powers of s and of t.
using Biquadratic = std::array<std::array<Vec3, 3>, 3>;

Biquadratic control_points(std::span<const Vec3> x) noexcept {
  // The serendipity functions have this value at the centre.
  const Vec3 centre = 0.5 * (x[4] + x[5] + x[6] + x[7]) - 0.25 * (x[0] + x[1] + x[2] + x[3]);
  Biquadratic b{{{x[0], x[7], x[3]}, {x[4], centre, x[6]}, {x[1], x[5], x[2]}}};
  for (auto& row : b) row[1] = control(row[0], row[1], row[2]);
  for (std::size_t k = 0; k < 3; ++k) b[1][k] = control(b[0][k], b[1][k], b[2][k]);
  return b;
}

Jacobian of_quad8(std::span<const Vec3> x) noexcept {
  const Biquadratic b = control_points(x);
  constexpr std::array<double, 3> of_two{1, 2, 1};     // binomials
  constexpr std::array<double, 4> of_three{1, 3, 3, 1};
  Jacobian j;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t m = 0; m < 3; ++m)
        for (std::size_t n = 0; n < 2; ++n) {
          const Vec3 s = 2 * (b[i + 1][k] - b[i][k]), t = 2 * (b[m][n + 1] - b[m][n]);
          const double weight = of_two[m] * of_two[k] / (of_three[i + m] * of_three[k + n]);
          j.c[4 * (i + m) + k + n] += weight * cross(s, t);
        }
  j.count = 16;
  return j;
}

double squared_area(const Vec3& s, const Vec3& t) noexcept {
  const Vec3 n = cross(s, t);
  return dot(n, n);
}
double squared_area(const Vec2& s, const Vec2& t) noexcept {
  const double n = cross(s, t);
  return n > 0 ? n * n : 0;
}

// S and T are the sides of the straight triangle. If derivatives differ by at most e from S and f from T, coefficients differ
// by at most b = e |T| + f |S| + e f from S x T, and by at most 2 b from their mean.
template <typename V>
double bound_of_least(std::span<const V> x) noexcept {
  const V ab = 2 * x[3] - x[0] - x[1], bc = 2 * x[4] - x[1] - x[2], ca = 2 * x[5] - x[2] - x[0];
  const V s = x[1] - x[0], t = x[2] - x[0], ds = bc - ca, dt = bc - ab;
  const double ss = dot(s, s), tt = dot(t, t), area = squared_area(s, t);
  constexpr double thin = 1e-12;  // rounding of the area is far smaller
  if (!(area > thin * ss * tt)) return -infinity;
  const double e = 4 * std::max(dot(ab, ab), dot(ds, ds)), f = 4 * std::max(dot(ca, ca), dot(dt, dt));
  const double share = std::sqrt(e * tt / area) + std::sqrt(f * ss / area) + std::sqrt(e * f / area);
  return share < 1 ? 1 - 2 * share / (1 - share) : -infinity;
}

}  // namespace

double min_of_triangle6(std::span<const Vec3> nodes) noexcept { return bound_of_least(nodes); }
double min_of_triangle6(std::span<const Vec2> nodes) noexcept { return bound_of_least(nodes); }

Vec3 Jacobian::mean() const noexcept {
  Vec3 sum{0, 0, 0};
  for (int i = 0; i < count; ++i) sum += c[static_cast<std::size_t>(i)];
  return (1.0 / count) * sum;
}

double Jacobian::min_along(const Vec3& direction) const noexcept {
  double least = 0, sum = 0;
  for (int i = 0; i < count; ++i) {
    const double value = dot(c[static_cast<std::size_t>(i)], direction);
    if (i == 0 || value < least) least = value;
    sum += value;
  }
  const double mean_value = sum / count;
  if (!(mean_value > 0)) return mean_value < 0 ? -1 : 0;
  return least / mean_value;
}

double Jacobian::least() const noexcept {
  const Vec3 m = mean();
  const double length = norm(m);
  return length > 0 ? min_along((1 / length) * m) : 0;
}

Jacobian jacobian(CellKind kind, std::span<const Vec3> nodes) noexcept {
  switch (kind) {
    case CellKind::triangle6:
      return of_triangle6(nodes);
    case CellKind::quad4:
      return of_quad4(nodes);
    case CellKind::quad8:
      return of_quad8(nodes);
    case CellKind::triangle3:
      break;
  }
  Jacobian j;
  j.c[0] = cross(nodes[1] - nodes[0], nodes[2] - nodes[0]);
  j.count = 1;
  return j;
}

Vec3 point_of_cell(CellKind kind, std::span<const Vec3> x, double s, double t) noexcept {
  const double r = 1 - s - t;
  switch (kind) {
    case CellKind::triangle6:
      return r * (2 * r - 1) * x[0] + s * (2 * s - 1) * x[1] + t * (2 * t - 1) * x[2] + 4 * r * s * x[3] +
             4 * s * t * x[4] + 4 * t * r * x[5];
    case CellKind::quad4:
      return (1 - s) * ((1 - t) * x[0] + t * x[3]) + s * ((1 - t) * x[1] + t * x[2]);
    case CellKind::quad8: {
      const double p = 1 - s, q = 1 - t;
      return p * q * (1 - 2 * s - 2 * t) * x[0] + s * q * (1 - 2 * p - 2 * t) * x[1] +
             s * t * (1 - 2 * p - 2 * q) * x[2] + p * t * (1 - 2 * s - 2 * q) * x[3] + 4 * s * p * q * x[4] +
             4 * t * q * s * x[5] + 4 * s * p * t * x[6] + 4 * t * q * p * x[7];
    }
    case CellKind::triangle3:
      break;
  }
  return r * x[0] + s * x[1] + t * x[2];
}

}  // namespace carreau
