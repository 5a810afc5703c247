// SPDX-License-Identifier: BSD-3-Clause
// Sums of doubles that represent a number exactly ([shewchuk-1997] sec. 2). Private to predicates/.
//
// Valid while no operation overflows or underflows: the caller looks at the exponents.
#pragma once

#include <array>
#include <cmath>

namespace carreau::detail {

struct TwoTerms {
  double high, low;  ///< high = round(value), low = value - high
};

/// At most N non-zero terms, of increasing magnitude, strongly non-overlapping; their sum is the value.
template <int N>
struct Expansion {
  std::array<double, N> term;  // the first `size` are set
  int size = 0;

  Expansion() = default;
  explicit Expansion(TwoTerms value) noexcept {
    push(value.low);
    push(value.high);
  }
  void push(double value) noexcept {
    if (value != 0) term[size++] = value;
  }
  /// The last term outweighs all others together.
  [[nodiscard]] int sign() const noexcept {
    if (size == 0) return 0;
    return term[size - 1] > 0 ? 1 : -1;
  }
};

/// a + b [shewchuk-1997] fig. 3 (Knuth).
inline TwoTerms two_sum(double a, double b) noexcept {
  const double high = a + b;
  const double b_part = high - a;
  const double a_part = high - b_part;
  return {high, (a - a_part) + (b - b_part)};
}

/// a + b for |a| >= |b| or a == 0 [shewchuk-1997] fig. 2 (Dekker).
inline TwoTerms fast_two_sum(double a, double b) noexcept {
  const double high = a + b;
  return {high, b - (high - a)};
}

/// The upper 26 bits and the rest [shewchuk-1997] fig. 5 (Dekker).
inline TwoTerms split(double a) noexcept {
  const double c = 134217729.0 * a;  // 2^27 + 1
  const double high = c - (c - a);
  return {high, a - high};
}

/// a * b [shewchuk-1997] fig. 6 (Dekker, Veltkamp); the portable baseline has no fused multiply-add.
inline TwoTerms two_product(double a, double b) noexcept {
  const double high = a * b;
  const TwoTerms p = split(a), q = split(b);
  const double rest = ((high - p.high * q.high) - p.low * q.high) - p.high * q.low;
  return {high, p.low * q.low - rest};
}

inline Expansion<2> difference(double a, double b) noexcept { return Expansion<2>(two_sum(a, -b)); }

/// e + f [shewchuk-1997] fig. 8: merge by magnitude, then carry upwards.
template <int M, int N>
Expansion<M + N> operator+(const Expansion<M>& e, const Expansion<N>& f) noexcept {
  Expansion<M + N> sum;
  if (e.size + f.size == 0) return sum;
  int i = 0, j = 0;
  const auto next = [&]() noexcept {
    if (j == f.size || (i < e.size && std::abs(e.term[i]) < std::abs(f.term[j]))) return e.term[i++];
    return f.term[j++];
  };
  double carry = next();
  while (i < e.size || j < f.size) {
    const TwoTerms s = two_sum(carry, next());
    sum.push(s.low);
    carry = s.high;
  }
  sum.push(carry);
  return sum;
}

template <int N>
Expansion<N> operator-(Expansion<N> e) noexcept {
  for (int i = 0; i < e.size; ++i) e.term[i] = -e.term[i];
  return e;
}

template <int M, int N>
Expansion<M + N> operator-(const Expansion<M>& e, const Expansion<N>& f) noexcept {
  return e + (-f);
}

/// e * b [shewchuk-1997] fig. 13.
template <int N>
Expansion<2 * N> operator*(const Expansion<N>& e, double b) noexcept {
  Expansion<2 * N> product;
  if (e.size == 0 || b == 0) return product;
  const TwoTerms first = two_product(e.term[0], b);
  product.push(first.low);
  double carry = first.high;
  for (int i = 1; i < e.size; ++i) {
    const TwoTerms p = two_product(e.term[i], b);
    const TwoTerms s = two_sum(carry, p.low);
    product.push(s.low);
    const TwoTerms t = fast_two_sum(p.high, s.high);
    product.push(t.low);
    carry = t.high;
  }
  product.push(carry);
  return product;
}

/// e * f: the sum of e * (terms of f), halved recursively so that the partial sums stay balanced.
template <int M, int N>
Expansion<2 * M * N> operator*(const Expansion<M>& e, const Expansion<N>& f) noexcept {
  if constexpr (N == 1) {
    return e * (f.size == 0 ? 0.0 : f.term[0]);
  } else {
    Expansion<N / 2> lower;
    Expansion<N - N / 2> upper;
    for (int i = 0; i < f.size; ++i) {
      if (i < N / 2)
        lower.push(f.term[i]);
      else
        upper.push(f.term[i]);
    }
    return e * lower + e * upper;
  }
}

}  // namespace carreau::detail
