// SPDX-License-Identifier: BSD-3-Clause
// Vertices of a boundary that come near its edges in space.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

#include "support/segment.h"
#include "support/vec.h"

namespace carreau {

/// The points in the order of a k-d tree: the middle point of each range divides the others along the longest side of
/// their box. Along x, y and z in turn, two of three divisions of a straight boundary would be useless.
class NearVertices {
 public:
  explicit NearVertices(const std::vector<Vec3>& points)
      : points_(points),
        order_(points.size()),
        axis_(points.size(), 0),
        left_(fewest_looked_at + looked_at_a_point * std::ssize(points)) {
    std::iota(order_.begin(), order_.end(), 0);
    part(0, std::ssize(points));
  }

  /// Visits vertices within `reach` of the segment (a, b), except at its ends, until `visit` returns false. If a
  /// boundary has hundreds of vertices beside each edge, for example .2 sin(1 / x), looking at all of them does not
  /// help. All calls together therefore visit a limited number of vertices.
  template <typename Visit>
  void each_beside(const Vec3& a, const Vec3& b, double reach, Visit&& visit) {
    const Vec3 margin{reach, reach, reach}, low = a.cwiseMin(b) - margin, high = a.cwiseMax(b) + margin;
    std::array<Range, deepest> stack;
    std::size_t top = 0;
    stack[top++] = {0, std::ssize(order_)};
    while (top > 0) {
      const auto [begin, end] = stack[--top];
      const auto sees = [&](int v) {
        const Vec3& p = points_[static_cast<std::size_t>(v)];
        return !(p == a) && !(p == b) && distance_to_segment(p, a, b) <= reach;
      };
      if (end - begin <= leaf) {
        left_ -= end - begin;
        if (left_ < 0) return;
        for (std::ptrdiff_t k = begin; k < end; ++k)
          if (const int v = order_[static_cast<std::size_t>(k)]; sees(v) && !visit(v)) return;
        continue;
      }
      if (--left_ < 0) return;
      const std::ptrdiff_t middle = (begin + end) / 2;
      const int v = order_[static_cast<std::size_t>(middle)];
      const Vec3& p = points_[static_cast<std::size_t>(v)];
      const int axis = axis_[static_cast<std::size_t>(middle)];
      if (high[axis] >= p[axis]) stack[top++] = {middle + 1, end};
      if (low[axis] <= p[axis]) stack[top++] = {begin, middle};
      if (sees(v) && !visit(v)) return;
    }
  }

  [[nodiscard]] bool any_beside(const Vec3& a, const Vec3& b, double reach) {
    bool any = false;
    each_beside(a, b, reach, [&](int) { return any = true, false; });
    return any;
  }

 private:
  struct Range {
    std::ptrdiff_t begin, end;
  };
  // Twice as many as there are halves of halves.
  static constexpr std::size_t deepest = 128;
  static constexpr std::ptrdiff_t leaf = 4;  // points
  // Vertices of the tree: sound boundaries of thousands of edges look at 30 a point.
  static constexpr std::int64_t fewest_looked_at = 1'000'000, looked_at_a_point = 300;

  void part(std::ptrdiff_t begin, std::ptrdiff_t end) {
    if (end - begin <= leaf) return;
    Vec3 low = points_[static_cast<std::size_t>(order_[static_cast<std::size_t>(begin)])], high = low;
    for (std::ptrdiff_t k = begin + 1; k < end; ++k) {
      const Vec3& p = points_[static_cast<std::size_t>(order_[static_cast<std::size_t>(k)])];
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const Vec3 side = high - low;
    const int axis = side[0] >= side[1] && side[0] >= side[2] ? 0 : side[1] >= side[2] ? 1 : 2;
    const std::ptrdiff_t middle = (begin + end) / 2;
    axis_[static_cast<std::size_t>(middle)] = static_cast<std::uint8_t>(axis);
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](int v, int w) {
      const double x = points_[static_cast<std::size_t>(v)][axis], y = points_[static_cast<std::size_t>(w)][axis];
      return x < y || (x == y && v < w);
    });
    part(begin, middle);
    part(middle + 1, end);
  }

  const std::vector<Vec3>& points_;
  std::vector<int> order_;
  std::vector<std::uint8_t> axis_;  // at the middle of each range
  std::int64_t left_;
};

}  // namespace carreau
