// SPDX-License-Identifier: BSD-3-Clause
#include "predicates/big_integer.h"

#include <algorithm>

namespace carreau::detail {

BigInteger::BigInteger(std::int64_t mantissa, int shift) noexcept : negative_(mantissa < 0) {
  const std::uint64_t magnitude =
      negative_ ? -static_cast<std::uint64_t>(mantissa) : static_cast<std::uint64_t>(mantissa);
  const int limbs = shift / 32, bits = shift % 32;
  std::fill_n(limb_.begin(), limbs, 0U);
  const std::uint64_t low = (magnitude & 0xffffffffU) << bits;
  const std::uint64_t high = ((magnitude >> 32) << bits) + (low >> 32);
  limb_[limbs] = static_cast<std::uint32_t>(low);
  limb_[limbs + 1] = static_cast<std::uint32_t>(high);
  limb_[limbs + 2] = static_cast<std::uint32_t>(high >> 32);
  size_ = limbs + 3;
  trim();
}

void BigInteger::trim() noexcept {
  while (size_ > 0 && limb_[size_ - 1] == 0) --size_;
}

bool BigInteger::smaller_magnitude(const BigInteger& p, const BigInteger& q) noexcept {
  if (p.size_ != q.size_) return p.size_ < q.size_;
  for (int i = p.size_ - 1; i >= 0; --i)
    if (p.limb_[i] != q.limb_[i]) return p.limb_[i] < q.limb_[i];
  return false;
}

BigInteger BigInteger::operator-() const noexcept {
  BigInteger opposite = *this;
  opposite.negative_ = !negative_;
  return opposite;
}

BigInteger operator+(const BigInteger& p, const BigInteger& q) noexcept {
  const bool swapped = BigInteger::smaller_magnitude(p, q);
  const BigInteger& larger = swapped ? q : p;
  const BigInteger& smaller = swapped ? p : q;
  const bool subtract = p.negative_ != q.negative_;
  BigInteger sum;
  sum.negative_ = larger.negative_;
  std::int64_t carry = 0;
  for (int i = 0; i < larger.size_; ++i) {
    const std::int64_t other = i < smaller.size_ ? static_cast<std::int64_t>(smaller.limb_[i]) : 0;
    carry += static_cast<std::int64_t>(larger.limb_[i]) + (subtract ? -other : other);
    sum.limb_[i] = static_cast<std::uint32_t>(carry);
    carry >>= 32;
  }
  sum.size_ = larger.size_;
  if (carry != 0) sum.limb_[sum.size_++] = static_cast<std::uint32_t>(carry);
  sum.trim();
  return sum;
}

BigInteger operator*(const BigInteger& p, const BigInteger& q) noexcept {
  BigInteger product;
  if (p.size_ == 0 || q.size_ == 0) return product;
  product.negative_ = p.negative_ != q.negative_;
  product.size_ = p.size_ + q.size_;
  std::fill_n(product.limb_.begin(), product.size_, 0U);
  for (int i = 0; i < p.size_; ++i) {
    std::uint64_t carry = 0;
    for (int j = 0; j < q.size_; ++j) {
      carry += static_cast<std::uint64_t>(p.limb_[i]) * q.limb_[j] + product.limb_[i + j];
      product.limb_[i + j] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    product.limb_[i + q.size_] = static_cast<std::uint32_t>(carry);
  }
  product.trim();
  return product;
}

}  // namespace carreau::detail
