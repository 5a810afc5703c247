// SPDX-License-Identifier: BSD-3-Clause
// Both coordinates in one register: each operation rounds like operations on single numbers, at half the instructions.
// Private to plane.
#pragma once

#include <cstring>

#include "plane/kernel/triangulation.h"

namespace carreau::plane {

using Pair = double __attribute__((vector_size(16)));

inline Pair both(double x) noexcept { return Pair{x, x}; }
inline Pair first_twice(Pair p) noexcept { return __builtin_shufflevector(p, p, 0, 0); }
inline Pair second_twice(Pair p) noexcept { return __builtin_shufflevector(p, p, 1, 1); }
inline Pair exchanged(Pair p) noexcept { return __builtin_shufflevector(p, p, 1, 0); }

inline Pair pair_of(const double* two) noexcept {
  Pair p;
  std::memcpy(&p, two, sizeof p);
  return p;
}
inline Pair pair_of(const Vertex& V) noexcept { return pair_of(&V.x); }
inline Pair pair_of(const Vec2& v) noexcept { return pair_of(v.data()); }
inline void put(Pair p, Vec2& to) noexcept { std::memcpy(to.data(), &p, sizeof p); }
inline void add(Pair p, Vec2& to) noexcept { put(pair_of(to) + p, to); }

}  // namespace carreau::plane
