// SPDX-License-Identifier: BSD-3-Clause
#include "predicates/polygon_locator.h"

#include <algorithm>

#include "predicates/predicates.h"

// Joins a point to the lower left corner C of its cell by a horizontal and a vertical leg; the crossings of edges along
// it and the known state of C decide. Ties: every point and corner (x, y) represents (x + e, y + e'), 0 < e' << e << 1.
// Then no point is on an edge, no leg meets a vertex, and exact orientation signs decide each crossing.

namespace carreau {
namespace {

/// Does the line y = level + e' meet the segment?
bool spans_level(const Vec2& p, const Vec2& q, double level) noexcept {
  return std::min(p.y(), q.y()) <= level && level < std::max(p.y(), q.y());
}

}  // namespace

PolygonLocator::PolygonLocator(std::span<const Vec2> vertices, std::span<const std::pair<int, int>> edges)
    : grid_(vertices, edges) {
  segment_.reserve(edges.size());
  reversed_.reserve(edges.size());
  for (const auto& [first, second] : edges) {
    const Vec2 a = vertices[first], b = vertices[second];
    const bool reversed = comes_after(a, b);
    segment_.push_back(reversed ? Segment{b, a} : Segment{a, b});
    reversed_.push_back(reversed ? 1 : 0);
  }
  find_corners();
}

/// Side of (p.x + e, p.y + e') seen along the segment: 1 left, -1 right, 0 only without length.
int PolygonLocator::side(const Segment& s, const Vec2& p) noexcept {
  const int sign = orientation(s.low, s.high, p);
  if (sign != 0) return sign;
  if (s.low.y() != s.high.y()) return s.low.y() < s.high.y() ? -1 : 1;
  return s.low.x() != s.high.x() ? 1 : 0;
}

/// Does the leg from the corner to (x, corner.y) cross the segment?
bool PolygonLocator::crosses_horizontally(const Segment& s, const Vec2& corner, double x) noexcept {
  if (!spans_level(s.low, s.high, corner.y()) || s.low.x() > x || s.high.x() < corner.x()) return false;
  return side(s, corner) != side(s, {x, corner.y()});
}

void PolygonLocator::find_corners() {
  const int columns = grid_.columns(), rows = grid_.rows();
  corner_inside_.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  std::size_t cell = 0;
  for (int row = 0; row < rows; ++row) {
    const double y = grid_.y(row);
    bool inside = false;
    // From far on the left, outside: the edges that touch the first line and pass the corner on its left.
    for (const int e : grid_.edges_in(0, row)) {
      const Segment& s = segment_[e];
      if (spans_level(s.low, s.high, y) && side(s, {grid_.x(0), y}) != (s.low.y() < s.high.y() ? 1 : -1)) inside = !inside;
    }
    for (int column = 0; column < columns; ++column, ++cell) {
      corner_inside_[cell] = inside ? 1 : 0;
      for (const int e : grid_.edges_in(column, row))
        if (crosses_horizontally(segment_[e], {grid_.x(column), y}, grid_.x(column + 1))) inside = !inside;
    }
  }
}

bool PolygonLocator::in_box(const Vec2& p) const noexcept {
  return !segment_.empty() && p.x() >= grid_.x(0) && p.x() <= grid_.x(grid_.columns()) && p.y() >= grid_.y(0) &&
         p.y() <= grid_.y(grid_.rows());
}

bool PolygonLocator::contains(const Vec2& p) const noexcept {
  if (!in_box(p)) return false;
  const int column = grid_.column_of(p.x()), row = grid_.row_of(p.y());
  const Vec2 corner{grid_.x(column), grid_.y(row)}, turn{p.x(), corner.y()};
  bool inside = corner_inside_[static_cast<std::size_t>(row) * grid_.columns() + column] != 0;
  for (const int e : grid_.edges_in(column, row)) {
    const Segment& s = segment_[e];
    if (crosses_horizontally(s, corner, p.x())) inside = !inside;
    if (p.x() < s.low.x() || p.x() > s.high.x()) continue;
    const double bottom = std::min(s.low.y(), s.high.y()), top = std::max(s.low.y(), s.high.y());
    if (p.y() < bottom) continue;
    if (p.y() <= top && orientation(s.low, s.high, p) == 0) return true;
    // The vertical leg is at p.x + e: an edge that ends at p.x does not meet it.
    if (p.x() < s.high.x() && top >= corner.y() && side(s, turn) != side(s, p)) inside = !inside;
  }
  return inside;
}

int PolygonLocator::edge_through(const Vec2& p) const noexcept {
  if (!in_box(p)) return -1;
  int lowest = -1;
  for (const int e : grid_.edges_in(grid_.column_of(p.x()), grid_.row_of(p.y()))) {
    const Segment& s = segment_[e];
    if (p.x() < s.low.x() || p.x() > s.high.x() || p.y() < std::min(s.low.y(), s.high.y()) || p.y() > std::max(s.low.y(), s.high.y()))
      continue;
    if ((lowest == -1 || e < lowest) && orientation(s.low, s.high, p) == 0) lowest = e;
  }
  return lowest;
}

/// As `contains`, for the point that lies on low - high, infinitely near to low, and then just below, or just right
/// when low - high is vertical. `edge`: which edge low - high is, or -1.
bool PolygonLocator::inside_below(const Vec2& low, const Vec2& high, int edge) const noexcept {
  const int column = grid_.column_of(low.x()), row = grid_.row_of(low.y());
  const Vec2 corner{grid_.x(column), grid_.y(row)}, turn{low.x(), corner.y()};
  bool inside = corner_inside_[static_cast<std::size_t>(row) * grid_.columns() + column] != 0;
  for (const int e : grid_.edges_in(column, row)) {
    const Segment& s = segment_[e];
    if (crosses_horizontally(s, corner, low.x())) inside = !inside;
    if (low.x() < s.low.x() || low.x() >= s.high.x()) continue;
    // An edge through `low` passes below the point when it passes below `high`.
    int target = orientation(s.low, s.high, low);
    if (target == 0) target = orientation(s.low, s.high, high);
    if (e == edge || target == 0) target = -1;
    if (side(s, turn) != target) inside = !inside;
  }
  return inside;
}

bool PolygonLocator::inside_left_of(int edge) const noexcept {
  const Segment& s = segment_[edge];
  if (s.low == s.high) return false;
  return (reversed_[edge] != 0) == inside_below(s.low, s.high, edge);
}

bool PolygonLocator::inside_along(const Vec2& p, const Vec2& q) const noexcept {
  if (p == q || !in_box(p) || !in_box(q)) return false;
  return comes_after(p, q) ? inside_below(q, p, -1) : inside_below(p, q, -1);
}

}  // namespace carreau
