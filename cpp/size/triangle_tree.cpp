#include "size/triangle_tree.h"

#include <algorithm>
#include <limits>

namespace carreau {

namespace {

constexpr std::int32_t leaf_size = 4;
constexpr std::int32_t nodes_between_checks = 1 << 14;
// Splitting halves the number of triangles: 2^31 of them make 31 levels, and each leaves one node to come back to.
constexpr int most_levels = 64;

double squared(Vec2 p) noexcept { return dot(p, p); }

struct OnSegment {
  double fraction, distance;  // distance: squared
};

OnSegment nearest_on_segment(Vec2 p, Vec2 a, Vec2 b) noexcept {
  const Vec2 d = b - a;
  const double l = dot(d, d), s = l > 0 ? std::clamp(dot(p - a, d) / l, 0., 1.) : 0;
  return {s, squared(p - (a + s * d))};
}

}  // namespace

TriangleTree::TriangleTree(const std::vector<Vec2>& vertices, const std::vector<std::array<std::int32_t, 3>>& triangles,
                           Monitor& monitor) {
  if (triangles.empty()) return;
  Vec2 high = low_ = vertices.front();
  for (const Vec2 p : vertices) {
    low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  scale_ = {high.x > low_.x ? 1 / (high.x - low_.x) : 1, high.y > low_.y ? 1 / (high.y - low_.y) : 1};
  const auto scaled = [&](std::int32_t v) {
    return Vec2{(vertices[v].x - low_.x) * scale_.x, (vertices[v].y - low_.y) * scale_.y};
  };
  const auto n = static_cast<std::int32_t>(triangles.size());
  std::vector<Corners> corners;
  std::vector<Vec2> middle;
  corners.reserve(triangles.size());
  middle.reserve(triangles.size());
  for (const auto& t : triangles) {
    corners.push_back({scaled(t[0]), scaled(t[1]), scaled(t[2])});
    middle.push_back((1. / 3) * (corners.back().a + corners.back().b + corners.back().c));
  }
  order_.resize(triangles.size());
  for (std::int32_t i = 0; i < n; ++i) order_[i] = i;
  corners_.swap(corners);
  nodes_.reserve(static_cast<std::size_t>(n));
  nodes_.emplace_back();
  build(0, 0, n, 0, middle, monitor);
  std::vector<Corners> sorted;
  sorted.reserve(corners_.size());
  for (const std::int32_t t : order_) sorted.push_back(corners_[t]);
  corners_.swap(sorted);
}

void TriangleTree::build(std::int32_t node, std::int32_t first, std::int32_t count, int depth,
                         std::vector<Vec2>& middle, Monitor& monitor) {
  if (node % nodes_between_checks == 0) monitor.checkpoint();
  constexpr double far = std::numeric_limits<double>::infinity();
  Box box{{far, far}, {-far, -far}}, middles = box;
  const auto include = [](Box& b, Vec2 p) {
    b.low = {std::min(b.low.x, p.x), std::min(b.low.y, p.y)};
    b.high = {std::max(b.high.x, p.x), std::max(b.high.y, p.y)};
  };
  for (std::int32_t i = first; i < first + count; ++i) {
    const Corners& c = corners_[order_[i]];
    for (const Vec2 p : {c.a, c.b, c.c}) include(box, p);
    include(middles, middle[order_[i]]);
  }
  nodes_[node].box = box;
  if (count <= leaf_size || depth + 1 >= most_levels) {
    nodes_[node].first = first;
    nodes_[node].count = count;
    return;
  }
  const bool along_x = middles.high.x - middles.low.x >= middles.high.y - middles.low.y;
  const auto begin = order_.begin() + first;
  const std::int32_t half = count / 2;
  std::nth_element(begin, begin + half, begin + count, [&](std::int32_t p, std::int32_t q) {
    const double x = along_x ? middle[p].x : middle[p].y, y = along_x ? middle[q].x : middle[q].y;
    return x != y ? x < y : p < q;
  });
  const auto child = static_cast<std::int32_t>(nodes_.size());
  nodes_[node].first = child;
  nodes_.emplace_back();
  nodes_.emplace_back();
  build(child, first, half, depth + 1, middle, monitor);
  build(child + 1, first + half, count - half, depth + 1, middle, monitor);
}

TrianglePlace TriangleTree::find(Vec2 uv) const noexcept {
  TrianglePlace best;
  if (nodes_.empty()) return best;
  const Vec2 p{(uv.x - low_.x) * scale_.x, (uv.y - low_.y) * scale_.y};
  double nearest = std::numeric_limits<double>::infinity();
  const auto distance_to = [p](const Box& b) {
    return squared({std::max({b.low.x - p.x, p.x - b.high.x, 0.}), std::max({b.low.y - p.y, p.y - b.high.y, 0.})});
  };
  std::int32_t todo[most_levels + 1];
  int size = 0;
  todo[size++] = 0;
  while (size > 0) {
    const Node& node = nodes_[todo[--size]];
    if (!(distance_to(node.box) < nearest)) continue;
    if (node.count == 0) {
      const double left = distance_to(nodes_[node.first].box), right = distance_to(nodes_[node.first + 1].box);
      todo[size++] = left <= right ? node.first + 1 : node.first;
      todo[size++] = left <= right ? node.first : node.first + 1;
      continue;
    }
    for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
      const auto [a, b, c] = corners_[i];
      const double area = cross(b - a, c - a);
      const std::array<double, 3> w{cross(b - p, c - p) / area, cross(c - p, a - p) / area, cross(a - p, b - p) / area};
      if (area > 0 && w[0] >= 0 && w[1] >= 0 && w[2] >= 0) return {order_[i], w, true};
      const std::array<OnSegment, 3> sides{nearest_on_segment(p, a, b), nearest_on_segment(p, b, c),
                                           nearest_on_segment(p, c, a)};
      for (int k = 0; k < 3; ++k) {
        if (!(sides[k].distance < nearest)) continue;
        nearest = sides[k].distance;
        best = {order_[i], {}, false};
        best.weight[k] = 1 - sides[k].fraction;
        best.weight[(k + 1) % 3] = sides[k].fraction;
      }
    }
  }
  return best;
}

}  // namespace carreau
