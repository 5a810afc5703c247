// SPDX-License-Identifier: BSD-3-Clause
// Coordinates as exact numbers: when expansions do, and as integers when not. Private to predicates/.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "predicates/big_integer.h"
#include "predicates/expansion.h"

namespace carreau::detail {

/// Coordinates in this range (or zero) multiply four at a time, with all their rounding errors, without overflow or
/// underflow. The last bit of the smallest is 2^-252, its fourth power 2^-1008 > 2^-1074.
inline constexpr double smallest_safe = 0x1p-200, largest_safe = 0x1p200;

inline bool is_safe(double x) noexcept {
  const double size = std::abs(x);
  return x == 0 || (size >= smallest_safe && size <= largest_safe);
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

}  // namespace carreau::detail
