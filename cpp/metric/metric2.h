// SPDX-License-Identifier: BSD-3-Clause
// Metric tensors of a parameter plane.
#pragma once

#include <algorithm>
#include <cmath>

#include "support/vec.h"

namespace carreau {

/// Symmetric positive definite tensor (a b; b c) (RR-2928 eq. 1): a vector d has length sqrt(a dx^2 + 2 b dx dy + c
/// dy^2). Unit: 1 / parameter^2, so lengths are in units of the prescribed size.
struct Metric2 {
  double a = 1, b = 0, c = 1;
  friend bool operator==(const Metric2&, const Metric2&) = default;
};

constexpr Metric2 operator+(Metric2 m, Metric2 n) noexcept { return {m.a + n.a, m.b + n.b, m.c + n.c}; }
constexpr Metric2 operator*(double s, Metric2 m) noexcept { return {s * m.a, s * m.b, s * m.c}; }

constexpr double determinant(Metric2 m) noexcept { return m.a * m.c - m.b * m.b; }
/// <p, q> in the metric.
inline double dot(Metric2 m, const Vec2& p, const Vec2& q) noexcept {
  return m.a * p.x() * q.x() + m.b * (p.x() * q.y() + p.y() * q.x()) + m.c * p.y() * q.y();
}
inline double squared_length(Metric2 m, const Vec2& d) noexcept { return dot(m, d, d); }
inline double length(Metric2 m, const Vec2& d) noexcept { return std::sqrt(squared_length(m, d)); }

/// Corners of a regular hexagon on the unit circle.
inline constexpr double half_root3 = 0.8660254037844386;
inline const Vec2 six_directions[] = {{1, 0},  {0.5, half_root3},   {-0.5, half_root3},
                                          {-1, 0}, {-0.5, -half_root3}, {0.5, -half_root3}};

/// Maps the unit circle to the unit circle of a metric, by the inverse of its Cholesky factor. Metrics that are
/// singular up to rounding count as if their ratio were at most 1e6.
class UnitCircle {
 public:
  explicit UnitCircle(Metric2 m) noexcept
      : p_(std::sqrt(m.a)), q_(m.b / p_), r_(std::sqrt(std::max(m.c - q_ * q_, 1e-12 * m.c))) {}
  /// The vector whose length in the metric is the Euclidean one of d.
  [[nodiscard]] Vec2 vector(const Vec2& d) const noexcept {
    const double y = d.y() / r_;
    return {(d.x() - q_ * y) / p_, y};
  }

 private:
  double p_, q_, r_;
};

/// J^T J / h^2 (RR-2928 eq. 27 for an isotropic size h): the metric that a prescribed size h in space induces on the
/// parameter plane. su, sv: first derivatives of the surface.
inline Metric2 induced_metric(const Vec3& su, const Vec3& sv, double h) noexcept {
  const double k = 1 / (h * h);
  return {k * dot(su, su), k * dot(su, sv), k * dot(sv, sv)};
}

}  // namespace carreau
