// SPDX-License-Identifier: BSD-3-Clause
// Metric tensors of space.
#pragma once

#include <cmath>

#include "metric/metric2.h"
#include "support/vec.h"

namespace carreau {

/// Symmetric positive definite tensor of space: a vector d has length sqrt(d^T M d), in units of the prescribed size;
/// unit: 1 / length^2 (RR-2928 eq. 1, HDR eq. 4.58).
struct Metric3 {
  double xx = 1, xy = 0, xz = 0, yy = 1, yz = 0, zz = 1;
  friend bool operator==(const Metric3&, const Metric3&) = default;
};

/// The metric of an isotropic size h > 0.
constexpr Metric3 isotropic_metric3(double h) noexcept {
  const double k = 1 / (h * h);
  return {k, 0, 0, k, 0, k};
}

/// M d.
inline Vec3 apply(const Metric3& m, const Vec3& d) noexcept {
  return {m.xx * d.x() + m.xy * d.y() + m.xz * d.z(), m.xy * d.x() + m.yy * d.y() + m.yz * d.z(),
          m.xz * d.x() + m.yz * d.y() + m.zz * d.z()};
}
inline double squared_length(const Metric3& m, const Vec3& d) noexcept { return dot(d, apply(m, d)); }
inline double length(const Metric3& m, const Vec3& d) noexcept { return std::sqrt(squared_length(m, d)); }

/// J^T M J (RR-2928 eq. 27, HDR eq. 4.63): the metric that the metric of space induces on the parameter plane. su, sv:
/// first derivatives of the surface.
inline Metric2 induced_metric(const Vec3& su, const Vec3& sv, const Metric3& m) noexcept {
  const Vec3 mu = apply(m, su), mv = apply(m, sv);
  return {dot(su, mu), dot(su, mv), dot(sv, mv)};
}

}  // namespace carreau
