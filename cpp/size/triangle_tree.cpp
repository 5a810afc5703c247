#include "size/triangle_tree.h"

#include <algorithm>
#include <cmath>

namespace carreau {

namespace {

// Of the extent: what rounding may make of the point of a triangle that is the point itself.
constexpr double rounding = 1e-14;

}  // namespace

TriangleTree::TriangleTree(const std::vector<Vec2>& vertices, const std::vector<std::array<std::int32_t, 3>>& triangles,
                           Monitor& monitor) {
  if (triangles.empty()) return;
  // Triangles as long as wide in the mean: boxes around them overlap least.
  Vec2 low = vertices.front(), high = low, length;
  for (const Vec2 p : vertices) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  for (const auto& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 edge = vertices[static_cast<std::size_t>(t[(i + 1) % 3])] - vertices[static_cast<std::size_t>(t[i])];
      length = length + Vec2{std::abs(edge.x), std::abs(edge.y)};
    }
  const double edges = 3 * static_cast<double>(triangles.size());
  low_ = low;
  scale_ = {length.x > 0 ? edges / length.x : 1, length.y > 0 ? edges / length.y : 1};
  inside_ = rounding * std::max((high.x - low.x) * scale_.x, (high.y - low.y) * scale_.y);
  std::vector<Vec3> scaled;
  scaled.reserve(vertices.size());
  for (const Vec2 p : vertices) scaled.push_back({(p.x - low_.x) * scale_.x, (p.y - low_.y) * scale_.y, 0});
  search_ = TriangleSearch(scaled, triangles, &monitor);
}

TrianglePlace TriangleTree::find(Vec2 uv) const noexcept {
  if (search_.empty()) return {};
  const NearestOnMesh nearest = search_.nearest({(uv.x - low_.x) * scale_.x, (uv.y - low_.y) * scale_.y, 0});
  return {nearest.triangle, nearest.weight, nearest.distance <= inside_};
}

}  // namespace carreau
