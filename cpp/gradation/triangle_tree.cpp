// SPDX-License-Identifier: BSD-3-Clause
#include "gradation/triangle_tree.h"

#include <algorithm>
#include <cmath>

#include "gradation/thresholds.h"
#include "model/triangle_sides.h"
#include "predicates/clamped_int.h"
#include "support/rounding_of.h"

namespace carreau {

using namespace thresholds::gradation;

TriangleTree::TriangleTree(const std::vector<Vec2>& vertices, const std::vector<std::array<std::int32_t, 3>>& triangles,
                           Monitor& monitor) {
  if (triangles.empty()) return;
  // Triangles as long as wide in the mean: boxes around them overlap least.
  Vec2 low = vertices.front(), high = low, length;
  for (const Vec2& p : vertices) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  for (const auto& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 edge = vertices[static_cast<std::size_t>(t[(i + 1) % 3])] - vertices[static_cast<std::size_t>(t[i])];
      length = length + Vec2{std::abs(edge.x()), std::abs(edge.y())};
    }
  const double edges = 3 * static_cast<double>(triangles.size());
  low_ = low;
  scale_ = {length.x() > 0 ? edges / length.x() : 1, length.y() > 0 ? edges / length.y() : 1};
  inside_ = rounding_of::digits * std::max((high.x() - low.x()) * scale_.x(), (high.y() - low.y()) * scale_.y());
  std::vector<Vec3> scaled;
  scaled.reserve(vertices.size());
  for (const Vec2& p : vertices)
    scaled.push_back({(p.x() - low_.x()) * scale_.x(), (p.y() - low_.y()) * scale_.y(), 0});
  search_ = TriangleSearch(scaled, triangles, &monitor);
  corners_.resize(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 p = scaled[static_cast<std::size_t>(triangles[t][i])];
      corners_[t].at[i] = {p.x(), p.y()};
    }
  join_sides(triangles);
  make_starts({(high.x() - low.x()) * scale_.x(), (high.y() - low.y()) * scale_.y()});
}

void TriangleTree::join_sides(const std::vector<std::array<std::int32_t, 3>>& triangles) {
  std::int32_t last = 0;
  for (const auto& t : triangles) last = std::max({last, t[0], t[1], t[2]});
  const std::vector<std::array<std::int32_t, 3>> beyond = triangles_beyond(triangles, static_cast<std::size_t>(last) + 1);
  for (std::size_t t = 0; t < triangles.size(); ++t) corners_[t].across = beyond[t];
}

// About one cell for each triangle; it holds the last centre in it, or the centre of the cell before.
void TriangleTree::make_starts(Vec2 extent) {
  const double count = static_cast<double>(corners_.size());
  const double side = std::sqrt(std::max(extent.x() * extent.y() / count, 1e-300));
  const auto cells = [&](double length) {
    return clamped_int(std::ceil(length / side), 1, static_cast<int>(corners_.size()));
  };
  columns_ = cells(extent.x()), rows_ = cells(extent.y());
  start_scale_ = {extent.x() > 0 ? columns_ / extent.x() : 0, extent.y() > 0 ? rows_ / extent.y() : 0};
  starts_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), -1);
  for (std::size_t t = 0; t < corners_.size(); ++t) {
    const auto& c = corners_[t].at;
    starts_[start_near((1.0 / 3) * (c[0] + c[1] + c[2]))] = static_cast<std::int32_t>(t);
  }
  std::int32_t last = 0;
  for (std::int32_t& start : starts_) start = last = start >= 0 ? start : last;
}

std::size_t TriangleTree::start_near(const Vec2& p) const noexcept {
  const auto cell = [](double x, std::int32_t count) {
    return x > 0 ? static_cast<std::size_t>(std::min(x, count - 1.0)) : 0;
  };
  return cell(p.y() * start_scale_.y(), rows_) * static_cast<std::size_t>(columns_) +
         cell(p.x() * start_scale_.x(), columns_);
}

// The only triangle that holds a point; -1 where that is not clear, or the way there is long or leaves the domain.
std::int32_t TriangleTree::walk(const Vec2& p) const noexcept {
  // A point so many roundings inside a triangle is in no other triangle. [TriangleTreePlaces.MatchTheNearestTriangle]
  const double clear = 1e5 * inside_;
  std::int32_t t = starts_[start_near(p)];
  for (int step = 0; step < 32 && /* longer walks are left to the search */ t >= 0; ++step) {
    const Corners& c = corners_[static_cast<std::size_t>(t)];
    std::int32_t next = -1;
    bool holds = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 from = c.at[i], along = c.at[(i + 1) % 3] - from;
      const double side = cross(along, p - from), least = clear * (std::abs(along.x()) + std::abs(along.y()));
      if (side > least) continue;
      holds = false;
      if (side >= -least) continue;
      next = c.across[i];
      break;
    }
    if (holds) return t;
    t = next;
  }
  return -1;
}

TrianglePlace TriangleTree::find(const Vec2& uv) const noexcept {
  if (search_.empty()) return {};
  const Vec2 p{(uv.x() - low_.x()) * scale_.x(), (uv.y() - low_.y()) * scale_.y()};
  const Vec3 flat{p.x(), p.y(), 0};
  NearestOnMesh nearest;
  if (const std::int32_t t = walk(p); t >= 0) {
    const auto& [a, b, c] = corners_[static_cast<std::size_t>(t)].at;
    nearest = nearest_on_triangle(flat, {Vec3{a.x(), a.y(), 0}, Vec3{b.x(), b.y(), 0}, Vec3{c.x(), c.y(), 0}});
    nearest.triangle = t;
  } else {
    nearest = search_.nearest(flat);
  }
  return {nearest.triangle, nearest.weight, nearest.distance <= inside_};
}

}  // namespace carreau
