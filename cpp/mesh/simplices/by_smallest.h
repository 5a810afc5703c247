// SPDX-License-Identifier: BSD-3-Clause
// Things of a mesh, such as sides of triangles, vertex by vertex, without a list of all of them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "support/memory/unfilled.h"

namespace carreau {

/// Entries. Number in memory at once, if there are not many more.
inline constexpr std::size_t entries_at_once = std::size_t{1} << 22;

/// Calls use(v, entries) for each vertex v that has any, ascending; `entries` (std::span<Entry>) may be sorted there.
/// `list` is called several times, with a function put(v, entry), and calls it for all entries, in equal order each
/// time. Each pass uses the entries of a part of the vertices, so that only they are in memory.
template <typename Entry, typename List, typename Use>
void by_smallest_vertex(std::size_t vertices, const List& list, const Use& use, std::size_t least = entries_at_once) {
  constexpr std::size_t passes = 8;  // over more entries than that
  std::vector<std::uint32_t> count(vertices, 0);
  std::size_t total = 0;
  list([&](std::int32_t v, const Entry&) { ++count[static_cast<std::size_t>(v)], ++total; });
  const std::size_t room = std::max(least, total / passes);
  UnfilledVector<Entry> entries;
  std::vector<std::size_t> next;
  for (std::size_t begin = 0, end = 0; begin < vertices; begin = end) {
    next.clear();
    std::size_t n = 0;
    for (end = begin; end < vertices && (end == begin || n + count[end] <= room); n += count[end++]) next.push_back(n);
    if (n == 0) continue;
    entries.resize(n);
    list([&](std::int32_t v, const Entry& entry) {
      const auto at = static_cast<std::size_t>(v);
      if (at >= begin && at < end) entries[next[at - begin]++] = entry;
    });
    for (std::size_t v = begin, from = 0; v < end; from = next[v++ - begin])
      if (count[v] > 0) use(static_cast<std::int32_t>(v), std::span<Entry>(entries.data() + from, count[v]));
  }
}

/// A side of a triangle, seen from its smaller vertex.
struct SideFrom {
  std::uint32_t key;  ///< twice the larger vertex, and 1 if the triangle runs from the smaller to the larger
  std::uint32_t triangle;

  [[nodiscard]] std::int32_t larger() const noexcept { return static_cast<std::int32_t>(key >> 1); }
  [[nodiscard]] bool forward() const noexcept { return (key & 1) != 0; }
};

/// Calls use(low, high, sides) for each edge, by its smaller and then its larger vertex, with the sides of triangles
/// that are it, by triangle. Triangles without length on a side do not have it.
template <typename Use>
void for_each_edge(std::span<const std::array<std::int32_t, 3>> triangles, std::size_t vertices, const Use& use,
                   std::size_t least = entries_at_once) {
  const auto list = [&](const auto& put) {
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::int32_t a = triangles[t][i], b = triangles[t][(i + 1) % 3];
        const auto high = static_cast<std::uint32_t>(std::max(a, b));
        if (a != b) put(std::min(a, b), SideFrom{2 * high + (a < b ? 1U : 0U), static_cast<std::uint32_t>(t)});
      }
  };
  by_smallest_vertex<SideFrom>(
      vertices, list,
      [&](std::int32_t low, std::span<SideFrom> sides) {
        std::sort(sides.begin(), sides.end(), [](const SideFrom& p, const SideFrom& q) {
          return p.larger() != q.larger() ? p.larger() < q.larger() : p.triangle < q.triangle;
        });
        for (std::size_t from = 0, to = 0; from < sides.size(); from = to) {
          while (to < sides.size() && sides[to].larger() == sides[from].larger()) ++to;
          use(low, sides[from].larger(), std::span<const SideFrom>(sides.subspan(from, to - from)));
        }
      },
      least);
}

}  // namespace carreau
