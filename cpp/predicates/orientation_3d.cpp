// SPDX-License-Identifier: BSD-3-Clause
#include "predicates/orientation_3d.h"

#include "predicates/exact_numbers.h"

namespace carreau::detail {
namespace {

bool in_safe_range(const Vec3& p) noexcept { return is_safe(p.x()) && is_safe(p.y()) && is_safe(p.z()); }

/// The formula for any ring of numbers; the arguments are differences to the last point.
template <typename Number>
int sign_of_volume(const Number& ax, const Number& ay, const Number& az, const Number& bx, const Number& by,
                   const Number& bz, const Number& cx, const Number& cy, const Number& cz) noexcept {
  return ((cx * by - bx * cy) * az + (ax * cy - cx * ay) * bz + (bx * ay - ax * by) * cz).sign();
}

bool all_equal(double p, double q, double r, double s) noexcept { return p == s && q == s && r == s; }

}  // namespace

int exact_orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) noexcept {
  // Flat faces are mostly parallel to axes.
  if (all_equal(a.x(), b.x(), c.x(), d.x()) || all_equal(a.y(), b.y(), c.y(), d.y()) ||
      all_equal(a.z(), b.z(), c.z(), d.z()))
    return 0;
  if (in_safe_range(a) && in_safe_range(b) && in_safe_range(c) && in_safe_range(d))
    return sign_of_volume(difference(a.x(), d.x()), difference(a.y(), d.y()), difference(a.z(), d.z()),
                          difference(b.x(), d.x()), difference(b.y(), d.y()), difference(b.z(), d.z()),
                          difference(c.x(), d.x()), difference(c.y(), d.y()), difference(c.z(), d.z()));
  if (!is_finite(a) || !is_finite(b) || !is_finite(c) || !is_finite(d)) return 0;
  const Integers<12> n({a.x(), a.y(), a.z(), b.x(), b.y(), b.z(), c.x(), c.y(), c.z(), d.x(), d.y(), d.z()});
  return sign_of_volume(n[0] - n[9], n[1] - n[10], n[2] - n[11], n[3] - n[9], n[4] - n[10], n[5] - n[11], n[6] - n[9],
                        n[7] - n[10], n[8] - n[11]);
}

}  // namespace carreau::detail
