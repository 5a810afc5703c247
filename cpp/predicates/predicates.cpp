// SPDX-License-Identifier: BSD-3-Clause
#include "predicates/predicates.h"

#include "predicates/exact_numbers.h"

namespace carreau::detail {
namespace {

bool in_safe_range(const Vec2& p) noexcept { return is_safe(p.x()) && is_safe(p.y()); }

/// The formulas for any ring of numbers; the arguments are differences to the last point.
template <typename Number>
int sign_of_orientation(const Number& ax, const Number& ay, const Number& bx, const Number& by) noexcept {
  return (ax * by - ay * bx).sign();
}

template <typename Number>
int sign_of_in_circle(const Number& ax, const Number& ay, const Number& bx, const Number& by, const Number& cx,
                      const Number& cy) noexcept {
  const auto a2 = ax * ax + ay * ay;
  const auto b2 = bx * bx + by * by;
  const auto c2 = cx * cx + cy * cy;
  return ((bx * cy - cx * by) * a2 + (cx * ay - ax * cy) * b2 + (ax * by - bx * ay) * c2).sign();
}

/// Sign of left - right for products of doubles that are exact in two terms: the higher terms decide unless equal,
/// because rounding is monotonic.
int compare(TwoTerms left, TwoTerms right) noexcept {
  if (left.high != right.high) return left.high > right.high ? 1 : -1;
  return (left.low > right.low) - (left.low < right.low);
}

}  // namespace

int exact_orientation(const Vec2& a, const Vec2& b, const Vec2& c) noexcept {
  // On a side parallel to an axis both products have a factor that is zero, exactly: differences never underflow.
  if ((a.x() == c.x() || b.y() == c.y()) && (a.y() == c.y() || b.x() == c.x())) return 0;
  if (!in_safe_range(a) || !in_safe_range(b) || !in_safe_range(c)) {
    if (!is_finite(a) || !is_finite(b) || !is_finite(c)) return 0;
    const Integers<6> n({a.x(), a.y(), b.x(), b.y(), c.x(), c.y()});
    return sign_of_orientation(n[0] - n[4], n[1] - n[5], n[2] - n[4], n[3] - n[5]);
  }
  const TwoTerms ax = two_sum(a.x(), -c.x()), ay = two_sum(a.y(), -c.y());
  const TwoTerms bx = two_sum(b.x(), -c.x()), by = two_sum(b.y(), -c.y());
  // Points on a straight side of a domain usually end here: their differences are exact.
  if (ax.low == 0 && ay.low == 0 && bx.low == 0 && by.low == 0)
    return compare(two_product(ax.high, by.high), two_product(ay.high, bx.high));
  return sign_of_orientation(Expansion<2>(ax), Expansion<2>(ay), Expansion<2>(bx), Expansion<2>(by));
}

int exact_in_circle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) noexcept {
  if (in_safe_range(a) && in_safe_range(b) && in_safe_range(c) && in_safe_range(d))
    return sign_of_in_circle(difference(a.x(), d.x()), difference(a.y(), d.y()), difference(b.x(), d.x()), difference(b.y(), d.y()),
                             difference(c.x(), d.x()), difference(c.y(), d.y()));
  if (!is_finite(a) || !is_finite(b) || !is_finite(c) || !is_finite(d)) return 0;
  const Integers<8> n({a.x(), a.y(), b.x(), b.y(), c.x(), c.y(), d.x(), d.y()});
  return sign_of_in_circle(n[0] - n[6], n[1] - n[7], n[2] - n[6], n[3] - n[7], n[4] - n[6], n[5] - n[7]);
}

}  // namespace carreau::detail
