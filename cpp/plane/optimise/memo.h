// SPDX-License-Identifier: BSD-3-Clause
// Results for triangles, edges and stars, valid as long as their vertices stay where they are. Private to plane/.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "support/vec.h"

namespace carreau::plane {

/// Stands for places of vertices: 64 bits, whose collisions are left out of account.
using PlaceKey = std::uint64_t;

/// Each bit of the result depends on each of k (splitmix64).
inline PlaceKey mixed(PlaceKey k) noexcept {
  k = (k ^ k >> 30) * 0xbf58476d1ce4e5b9U;
  k = (k ^ k >> 27) * 0x94d049bb133111ebU;
  return k ^ k >> 31;
}
inline PlaceKey key_of_place(const Vec2& p) noexcept {
  return mixed(mixed(std::bit_cast<std::uint64_t>(p.x())) + std::bit_cast<std::uint64_t>(p.y()));
}
inline PlaceKey key_of_side(PlaceKey from, PlaceKey to) noexcept { return from ^ std::rotl(to, 32); }
/// From whatever corner it starts.
inline PlaceKey key_of_triangle(PlaceKey p, PlaceKey q, PlaceKey r) noexcept {
  return key_of_side(p, q) + key_of_side(q, r) + key_of_side(r, p);
}
/// Key of the diagonal ab of the quadrilateral c a d b, equal from both sides.
inline PlaceKey key_of_diagonal(PlaceKey c, PlaceKey a, PlaceKey b, PlaceKey d) noexcept {
  return key_of_side(c, a) + key_of_side(a, d) + key_of_side(d, b) + key_of_side(b, c) + 3 * (a + b);
}

/// Key of a star: the vertex and its link; place(v): the key of the place of v.
template <typename Place>
PlaceKey key_of_star(int v, const std::vector<std::int32_t>& link, const Place& place) {
  PlaceKey sum = 5 * place(v), last = place(link.back());
  for (const std::int32_t u : link) {
    const PlaceKey key = place(u);
    sum += key_of_side(last, key);
    last = key;
  }
  return sum;
}

/// Keeps the last value of the keys that share a slot.
template <typename Value>
class Memo {
 public:
  /// Null: not known.
  [[nodiscard]] const Value* find(PlaceKey key) const noexcept {
    const Entry& e = entries_[place(key)];
    return e.key == key ? &e.value : nullptr;
  }
  void put(PlaceKey key, const Value& value) noexcept { entries_[place(key)] = {key, value}; }
  /// Forgets all.
  void clear() { entries_.assign(std::size_t{1} << bits, Entry{}); }

 private:
  static constexpr int bits = 10;
  struct Entry {
    PlaceKey key = 0;
    Value value{};
  };
  static std::size_t place(PlaceKey key) noexcept {
    return static_cast<std::size_t>(key * 0x9e3779b97f4a7c15U >> (64 - bits));
  }

  std::vector<Entry> entries_;
};

}  // namespace carreau::plane
