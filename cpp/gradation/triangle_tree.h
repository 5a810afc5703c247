// SPDX-License-Identifier: BSD-3-Clause
// Nearest triangle of a plane triangulation, in logarithmic time.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/triangle_search.h"

namespace carreau {

/// Location of a point: a triangle and barycentric coordinates there. Outside all triangles: of the nearest point.
struct TrianglePlace {
  std::int32_t triangle = -1;  ///< -1: there are no triangles
  std::array<double, 3> weight{};
  bool inside = false;  ///< within rounding
};

/// A TriangleSearch in units of the mean edge in u and in v, which may have nothing in common. A walk from a triangle
/// nearby finds most points, before the search is used. find() is safe from several threads.
class TriangleTree {
 public:
  TriangleTree() = default;
  /// Throws Cancelled.
  TriangleTree(const std::vector<Vec2>& vertices, const std::vector<std::array<std::int32_t, 3>>& triangles,
               Monitor& monitor);

  /// Deterministic: returns the lowest index of triangles equally near.
  [[nodiscard]] TrianglePlace find(const Vec2& p) const noexcept;

 private:
  struct Corners {
    std::array<Vec2, 3> at{};                        // scaled
    std::array<std::int32_t, 3> across{-1, -1, -1};  // triangles beyond the sides from each corner to the next
  };
  void join_sides(const std::vector<std::array<std::int32_t, 3>>& triangles);
  void make_starts(Vec2 extent);  // of the scaled vertices
  [[nodiscard]] std::size_t start_near(const Vec2& p) const noexcept;
  [[nodiscard]] std::int32_t walk(const Vec2& p) const noexcept;

  Vec2 low_, scale_{1, 1};
  double inside_ = 0;  // distance that rounding may leave between a triangle and a point of it, scaled
  TriangleSearch search_;
  std::vector<Corners> corners_;
  std::int32_t columns_ = 0, rows_ = 0;
  Vec2 start_scale_;                  // from scaled points to cells of starts_
  std::vector<std::int32_t> starts_;  // a triangle near each cell of a grid
};

}  // namespace carreau
