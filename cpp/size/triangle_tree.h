// Nearest triangle of a plane triangulation, in logarithmic time.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "support/monitor.h"
#include "support/vec.h"

namespace carreau {

/// Where a point lies: a triangle and barycentric coordinates there. Outside all triangles: of the nearest point.
struct TrianglePlace {
  std::int32_t triangle = -1;  ///< -1: there are no triangles
  std::array<double, 3> weight{};
  bool inside = false;
};

/// Boxes of triangles, halved at the median: a search looks at some log2(n) of them. Keeps its own copy. Calls of
/// find() are safe from several threads.
class TriangleTree {
 public:
  TriangleTree() = default;
  /// Distances are measured in units of the box of all vertices: units of u and v may have nothing in common.
  TriangleTree(const std::vector<Vec2>& vertices, const std::vector<std::array<std::int32_t, 3>>& triangles,
               Monitor& monitor);

  /// Deterministic: of triangles equally near, always the same one.
  [[nodiscard]] TrianglePlace find(Vec2 p) const noexcept;

 private:
  struct Box {
    Vec2 low, high;
  };
  struct Node {
    Box box;
    std::int32_t first = 0, count = 0;  // count > 0: a leaf, in order_; else children first and first + 1
  };
  struct Corners {
    Vec2 a, b, c;
  };

  void build(std::int32_t node, std::int32_t first, std::int32_t count, int depth, std::vector<Vec2>& middle,
             Monitor& monitor);

  Vec2 low_, scale_{1, 1};
  std::vector<std::int32_t> order_;
  std::vector<Corners> corners_;  // of order_[i]
  std::vector<Node> nodes_;
};

}  // namespace carreau
