// SPDX-License-Identifier: BSD-3-Clause
// Integers as large as four coordinates multiplied together. Private to predicates/: the refuge for coordinates so
// large or so small that products of doubles would overflow or underflow.
#pragma once

#include <array>
#include <cstdint>

namespace carreau::detail {

/// Sign and magnitude in 32-bit limbs, lowest first, no leading zero limb. On the stack: predicates must not throw.
class BigInteger {
 public:
  BigInteger() = default;
  /// mantissa * 2^shift, 0 <= shift <= max_shift.
  BigInteger(std::int64_t mantissa, int shift) noexcept;

  [[nodiscard]] int sign() const noexcept { return size_ == 0 ? 0 : (negative_ ? -1 : 1); }

  BigInteger operator-() const noexcept;
  friend BigInteger operator+(const BigInteger& p, const BigInteger& q) noexcept;
  friend BigInteger operator-(const BigInteger& p, const BigInteger& q) noexcept { return p + (-q); }
  friend BigInteger operator*(const BigInteger& p, const BigInteger& q) noexcept;

  /// From the last bit of the smallest double, 2^-1074, to the first of the largest.
  static constexpr int max_shift = 1023 + 1074;

 private:
  // A difference of two coordinates has at most max_shift + 2 bits; in_circle multiplies four and adds twelve such.
  static constexpr int capacity = 4 * ((max_shift + 2) / 32 + 1) + 2;

  static bool smaller_magnitude(const BigInteger& p, const BigInteger& q) noexcept;
  void trim() noexcept;

  std::array<std::uint32_t, capacity> limb_;  // the first size_ are set
  int size_ = 0;
  bool negative_ = false;
};

}  // namespace carreau::detail
