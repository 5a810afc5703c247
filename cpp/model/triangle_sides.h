// SPDX-License-Identifier: BSD-3-Clause
// The sides of triangles, joined over their edges.
#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "model/bucket_sort.h"

namespace carreau {

/// Side `rank` of a triangle, from that corner to the next one.
struct TriangleSide {
  std::array<std::int32_t, 2> edge;  ///< its vertices, ascending
  std::int32_t triangle, rank;
  friend auto operator<=>(const TriangleSide&, const TriangleSide&) = default;
};

/// All sides, ascending. `vertex(t, i)`: corner i of triangle t, below `vertices`.
template <typename Vertex>
std::vector<TriangleSide> sides_of_triangles(std::size_t triangles, std::size_t vertices, const Vertex& vertex) {
  std::vector<TriangleSide> sides;
  sides.reserve(3 * triangles);
  for (std::size_t t = 0; t < triangles; ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t a = vertex(t, i), b = vertex(t, (i + 1) % 3);
      sides.push_back({{std::min(a, b), std::max(a, b)}, static_cast<std::int32_t>(t), static_cast<std::int32_t>(i)});
    }
  bucket_sort(sides, vertices, [](const TriangleSide& side) { return side.edge[0]; });
  return sides;
}

/// Calls `use(sides)` for each edge, with its sides, ascending by triangle.
template <typename Use>
void for_edges(std::span<const TriangleSide> sides, const Use& use) {
  for (std::size_t k = 0, n = 0; k < sides.size(); k += n) {
    for (n = 1; k + n < sides.size() && sides[k + n].edge == sides[k].edge;) ++n;
    use(sides.subspan(k, n));
  }
}

/// Returns, by triangle and side, the triangle beyond; -1: none, or more than one.
inline std::vector<std::array<std::int32_t, 3>> triangles_beyond(std::span<const std::array<std::int32_t, 3>> triangles, std::size_t vertices) {
  std::vector<std::array<std::int32_t, 3>> beyond(triangles.size(), {-1, -1, -1});
  for_edges(sides_of_triangles(triangles.size(), vertices, [&](std::size_t t, std::size_t i) { return triangles[t][i]; }),
            [&](std::span<const TriangleSide> sides) {
              if (sides.size() != 2) return;
              const auto set = [&](const TriangleSide& side, const TriangleSide& other) {
                beyond[static_cast<std::size_t>(side.triangle)][static_cast<std::size_t>(side.rank)] = other.triangle;
              };
              set(sides[0], sides[1]), set(sides[1], sides[0]);
            });
  return beyond;
}

}  // namespace carreau
