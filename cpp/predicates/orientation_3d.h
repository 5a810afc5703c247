// SPDX-License-Identifier: BSD-3-Clause
// On which side of a plane a point lies, exactly: as the predicates of the plane (predicates.h).
#pragma once

#include <cmath>

#include "predicates/predicates.h"
#include "support/vec.h"

namespace carreau {

namespace detail {
/// The sign without the filter.
int exact_orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) noexcept;

/// (7 + 56 e) e with e = 2^-53 ([shewchuk-1997] sec. 4.3).
inline constexpr double orientation_3d_bound = 7.7715611723761027e-16;
}  // namespace detail

/// Sign of the volume of (a, b, c, d), (b - a) x (c - a) . (d - a): +1 when a, b, c are counterclockwise as d sees
/// them, -1 clockwise, 0 when all are in one plane. Exact for all finite doubles; meaningless for infinities and NaN.
inline int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) noexcept {
  const double ax = a.x() - d.x(), ay = a.y() - d.y(), az = a.z() - d.z();
  const double bx = b.x() - d.x(), by = b.y() - d.y(), bz = b.z() - d.z();
  const double cx = c.x() - d.x(), cy = c.y() - d.y(), cz = c.z() - d.z();
  const double axby = ax * by, bxay = bx * ay;
  const double bxcy = bx * cy, cxby = cx * by;
  const double cxay = cx * ay, axcy = ax * cy;
  // Seen from d the three run clockwise when the determinant of the differences is positive.
  const double det = az * (cxby - bxcy) + bz * (axcy - cxay) + cz * (bxay - axby);
  const double size = std::abs(az) * (std::abs(bxcy) + std::abs(cxby)) +
                      std::abs(bz) * (std::abs(cxay) + std::abs(axcy)) +
                      std::abs(cz) * (std::abs(axby) + std::abs(bxay));
  const double bound =
      detail::orientation_3d_bound * size + detail::underflow_bound * (1 + std::abs(az) + std::abs(bz) + std::abs(cz));
  // An overflow makes the bound infinite or NaN, and both comparisons false.
  if (det > bound) return 1;
  if (-det > bound) return -1;
  return detail::exact_orientation(a, b, c, d);
}

}  // namespace carreau
