// SPDX-License-Identifier: BSD-3-Clause
// Numbers of vertices, scattered over 64 bits. Private to mesh/.
#pragma once

#include <cstdint>

namespace carreau {

/// A number for each vertex. If neighbours round a vertex are added where a triangle begins and subtracted where one ends, a sum of 0 shows that
/// the triangles close: other sums are 0 by chance once in 2^64. (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014)
inline std::uint64_t vertex_hash(std::int32_t v) noexcept {
  std::uint64_t x = (static_cast<std::uint64_t>(v) + 1) * 0x9E3779B97F4A7C15U;
  x = (x ^ x >> 30) * 0xBF58476D1CE4E5B9U;
  x = (x ^ x >> 27) * 0x94D049BB133111EBU;
  return x ^ x >> 31;
}

}  // namespace carreau
