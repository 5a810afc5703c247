#include "size/triangle_tree.h"

#include <algorithm>

namespace carreau {

namespace {

// Of the box: what rounding may make of the point of a triangle that is the point itself.
constexpr double rounding = 1e-14;

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
  std::vector<Vec3> scaled;
  scaled.reserve(vertices.size());
  for (const Vec2 p : vertices) scaled.push_back({(p.x - low_.x) * scale_.x, (p.y - low_.y) * scale_.y, 0});
  search_ = TriangleSearch(scaled, triangles, &monitor);
}

TrianglePlace TriangleTree::find(Vec2 uv) const noexcept {
  if (search_.empty()) return {};
  const NearestOnMesh nearest = search_.nearest({(uv.x - low_.x) * scale_.x, (uv.y - low_.y) * scale_.y, 0});
  return {nearest.triangle, nearest.weight, nearest.distance <= rounding};
}

}  // namespace carreau
