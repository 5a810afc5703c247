// SPDX-License-Identifier: BSD-3-Clause
// Point-in-polygon by the even-odd rule, exact, for many points.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "predicates/edge_grid.h"
#include "support/vec.h"

namespace carreau {

/// The closed set of points that the even-odd rule puts inside closed loops of edges, any number and direction.
/// Edges may be in any order. Duplicated edges cancel out, and their points still count as inside.
class PolygonLocator {
 public:
  /// Copies its arguments. Edges that do not form closed loops give an answer without meaning, but no crash.
  PolygonLocator(std::span<const Vec2> vertices, std::span<const std::pair<int, int>> edges);

  /// Inside or on an edge. Exact for finite points; false for others. Thread-safe.
  [[nodiscard]] bool contains(const Vec2& p) const noexcept;
  /// The lowest index of an edge that holds p (ends included), or -1.
  [[nodiscard]] int edge_through(const Vec2& p) const noexcept;
  /// For an edge whose points are on no other edge, except its ends: is its left side (from first to second) inside?
  /// Edges without length have none: false.
  [[nodiscard]] bool inside_left_of(int edge) const noexcept;
  /// Is the segment p - q, which meets edges at most at its ends, inside? Decided next to one end. False when p == q.
  [[nodiscard]] bool inside_along(const Vec2& p, const Vec2& q) const noexcept;

 private:
  struct Segment {
    Vec2 low, high;  // low comes before high in the order of x, then y
  };
  static bool comes_after(const Vec2& p, const Vec2& q) noexcept { return q.x() < p.x() || (q.x() == p.x() && q.y() < p.y()); }
  static int side(const Segment& s, const Vec2& p) noexcept;
  static bool crosses_horizontally(const Segment& s, const Vec2& corner, double x) noexcept;
  void find_corners();
  [[nodiscard]] bool inside_below(const Vec2& low, const Vec2& high, int edge) const noexcept;
  [[nodiscard]] bool in_box(const Vec2& p) const noexcept;

  std::vector<Segment> segment_;
  std::vector<char> reversed_;  // edge runs from high to low
  EdgeGrid grid_;
  std::vector<char> corner_inside_;  // infinitely near to the lower left corner of each cell
};

}  // namespace carreau
