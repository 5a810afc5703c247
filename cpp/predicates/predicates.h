// SPDX-License-Identifier: BSD-3-Clause
// Exact signs. No other room of the engine compares a determinant with zero to decide a topology.
//
// Each predicate is first evaluated in plain doubles with a bound of its rounding errors ([shewchuk-1997] sec. 4, "A"
// stages). This is inline because the plane mesher calls it millions of times; undecided cases are computed exactly out
// of line. The bounds need round-to-nearest and uncontracted operations (-ffp-contract=off).
#pragma once

#include <cmath>

#include "support/vec.h"

namespace carreau {

namespace detail {
/// The signs without the filter.
int exact_orientation(const Vec2& a, const Vec2& b, const Vec2& c) noexcept;
int exact_in_circle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) noexcept;

/// (3 + 16 e) e and (10 + 96 e) e with e = 2^-53 ([shewchuk-1997] sec. 4.3 and 4.4).
inline constexpr double orientation_bound = 3.3306690738754716e-16;
inline constexpr double in_circle_bound = 1.1102230246251577e-15;
/// Far above the loss by underflow of a product (2^-1075), far below any determinant of a real mesh.
inline constexpr double underflow_bound = 1e-290;
}  // namespace detail

/// Sign of the area of (a, b, c): +1 counterclockwise, -1 clockwise, 0 collinear. Exact for all finite doubles,
/// however large or small; meaningless for infinities and NaN.
inline int orientation(const Vec2& a, const Vec2& b, const Vec2& c) noexcept {
  const double left = (a.x() - c.x()) * (b.y() - c.y());
  const double right = (a.y() - c.y()) * (b.x() - c.x());
  const double det = left - right;
  const double bound = detail::orientation_bound * (std::abs(left) + std::abs(right)) + detail::underflow_bound;
  // An overflow makes the bound infinite or NaN, and both comparisons false.
  if (det > bound) return 1;
  if (-det > bound) return -1;
  return detail::exact_orientation(a, b, c);
}

/// +1 when d lies inside the circle through a, b, c (counterclockwise), -1 outside, 0 on it; the opposite when a, b, c
/// are clockwise. Exact for all finite doubles.
inline int in_circle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) noexcept {
  const double ax = a.x() - d.x(), ay = a.y() - d.y();
  const double bx = b.x() - d.x(), by = b.y() - d.y();
  const double cx = c.x() - d.x(), cy = c.y() - d.y();
  const double bxcy = bx * cy, cxby = cx * by;
  const double cxay = cx * ay, axcy = ax * cy;
  const double axby = ax * by, bxay = bx * ay;
  const double a2 = ax * ax + ay * ay;
  const double b2 = bx * bx + by * by;
  const double c2 = cx * cx + cy * cy;
  const double det = a2 * (bxcy - cxby) + b2 * (cxay - axcy) + c2 * (axby - bxay);
  const double size = a2 * (std::abs(bxcy) + std::abs(cxby)) + b2 * (std::abs(cxay) + std::abs(axcy)) +
                      c2 * (std::abs(axby) + std::abs(bxay));
  // A product that underflows is wrong by at most 2^-1075, and is then multiplied by at most the largest of a2, b2, c2.
  const double bound = detail::in_circle_bound * size + detail::underflow_bound * (1 + a2 + b2 + c2);
  if (det > bound) return 1;
  if (-det > bound) return -1;
  return detail::exact_in_circle(a, b, c, d);
}

}  // namespace carreau
