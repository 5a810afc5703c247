#include "predicates/predicates.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "predicates/big_integer.h"
#include "predicates/expansion.h"

namespace carreau::detail {
namespace {

/// Coordinates in this range (or zero) multiply four at a time, with all their rounding errors, without overflow or
/// underflow: the last bit of the smallest is 2^-252, its fourth power 2^-1008 > 2^-1074.
constexpr double smallest = 0x1p-200, largest = 0x1p200;

bool in_safe_range(double x) noexcept {
  const double size = std::abs(x);
  return x == 0 || (size >= smallest && size <= largest);
}

bool in_safe_range(const Vec2& p) noexcept { return in_safe_range(p.x()) && in_safe_range(p.y()); }

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

/// Doubles as integer multiples of the last bit of the smallest of them.
template <std::size_t N>
class Integers {
 public:
  explicit Integers(const std::array<double, N>& value) noexcept {
    for (std::size_t i = 0; i < N; ++i) {
      const double fraction = std::frexp(value[i], &exponent_[i]);
      mantissa_[i] = static_cast<std::int64_t>(std::ldexp(fraction, 53));
      exponent_[i] -= 53;
      if (mantissa_[i] == 0) continue;
      // Short: and frexp normalises subnormal numbers, whose last bit is 2^-1074.
      const int zeros = std::countr_zero(static_cast<std::uint64_t>(mantissa_[i]));
      mantissa_[i] >>= zeros;
      exponent_[i] += zeros;
      lowest_ = std::min(lowest_, exponent_[i]);
    }
  }
  [[nodiscard]] BigInteger operator[](std::size_t i) const noexcept {
    return mantissa_[i] == 0 ? BigInteger() : BigInteger(mantissa_[i], exponent_[i] - lowest_);
  }

 private:
  std::array<std::int64_t, N> mantissa_{};
  std::array<int, N> exponent_{};
  int lowest_ = 2000;
};

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
