// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/distance/heights.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace carreau {

namespace {

std::size_t offset(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

/// Share of the extent of polygon and triangle by which polygons are widened: the signs of clips are rounded.
constexpr double widened = 1e-12;
/// Share of the square of the longest side: a triangle with a smaller area, seen along the normal, has no sure turn.
constexpr double upright = 1e-10;

/// Numbers that were added.
class Seen {
 public:
  /// False: it was there.
  bool add(std::int32_t value) {
    if (2 * (count_ + 1) > table_.size()) grow();
    return put(value);
  }

 private:
  bool put(std::int32_t value) {
    std::size_t k = (static_cast<std::uint32_t>(value) * std::uint64_t{0x9E3779B97F4A7C15u} >> 32) & (table_.size() - 1);
    for (; table_[k] >= 0; k = (k + 1) & (table_.size() - 1))
      if (table_[k] == value) return false;
    table_[k] = value, ++count_;
    return true;
  }
  void grow() {
    std::vector<std::int32_t> old(std::max<std::size_t>(32, 4 * table_.size()), -1);
    old.swap(table_);
    count_ = 0;
    for (const std::int32_t value : old)
      if (value >= 0) put(value);
  }

  std::vector<std::int32_t> table_;
  std::size_t count_ = 0;
};

/// A widened polygon in the plane, and the points over it.
class Window {
 public:
  Window(std::span<const Vec3> polygon, const Vec3& normal) : origin_(polygon[0]), up_(normal) {
    const std::size_t axis = std::abs(normal.x()) < 0.6 ? 0 : 1;
    Vec3 e = Vec3::Zero();
    e[static_cast<int>(axis)] = 1;
    const Vec3 across = cross(normal, e);
    right_ = across / norm(across);
    ahead_ = cross(normal, right_);
    for (const Vec3& p : polygon) corners_.push_back(flat(p));
    for (const Vec3& p : corners_) extent_ = std::max({extent_, std::abs(p.x()), std::abs(p.y())});
    double twice = 0;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const Vec3 &p = corners_[i], &q = corners_[(i + 1) % corners_.size()];
      twice += p.x() * q.y() - p.y() * q.x();
    }
    const double turn = twice < 0 ? -1 : 1;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const Vec3 &p = corners_[i], &q = corners_[(i + 1) % corners_.size()];
      const double dx = turn * (q.x() - p.x()), dy = turn * (q.y() - p.y()), length = std::hypot(dx, dy);
      if (length > 0) sides_.push_back({-dy / length, dx / length, (p.x() * dy - p.y() * dx) / length});
    }
  }

  /// (x, y) in the plane, and the height.
  [[nodiscard]] Vec3 flat(const Vec3& p) const {
    const Vec3 d = p - origin_;
    return {dot(d, right_), dot(d, ahead_), dot(d, up_)};
  }

  /// Keeps the part of points or polygons of flat() over the window; points without sides in between are a segment.
  void clip(std::vector<Vec3>& points, std::vector<Vec3>& room) const {
    double extent = extent_;
    for (const Vec3& p : points) extent = std::max({extent, std::abs(p.x()), std::abs(p.y())});
    const double slack = widened * extent;
    for (const Side& side : sides_) {
      const auto inside = [&](const Vec3& p) { return side.x * p.x() + side.y * p.y() + side.c + slack; };
      room.clear();
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3 &p = points[i], &q = points[(i + 1) % points.size()];
        const double at_p = inside(p), at_q = inside(q);
        if (at_p >= 0) room.push_back(p);
        if ((at_p >= 0) != (at_q >= 0)) room.push_back(p + at_p / (at_p - at_q) * (q - p));
      }
      points.swap(room);
      if (points.empty()) return;
    }
  }

 private:
  struct Side {
    double x, y, c;
  };

  Vec3 origin_, up_, right_, ahead_;
  std::vector<Vec3> corners_;
  std::vector<Side> sides_;
  double extent_ = 0;
};

}  // namespace

HeightSearch::HeightSearch(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles)
    : vertices_(vertices), triangles_(triangles), beyond_(triangles.size(), {-1, -1, -1}) {
  struct Side {
    std::int32_t low, high, triangle, side;
  };
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t a = triangles[t][i], b = triangles[t][(i + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<std::int32_t>(t), static_cast<std::int32_t>(i)});
    }
  std::ranges::sort(sides, [](const Side& p, const Side& q) {
    return std::pair(p.low, p.high) < std::pair(q.low, q.high);
  });
  for (std::size_t k = 0; k < sides.size();) {
    std::size_t end = k + 1;
    while (end < sides.size() && sides[end].low == sides[k].low && sides[end].high == sides[k].high) ++end;
    if (end == k + 2) {
      beyond_[offset(sides[k].triangle)][offset(sides[k].side)] = sides[k + 1].triangle;
      beyond_[offset(sides[k + 1].triangle)][offset(sides[k + 1].side)] = sides[k].triangle;
    }
    k = end;
  }
}

std::optional<double> HeightSearch::largest_over(std::span<const Vec3> polygon, const Vec3& normal, std::int32_t start,
                                                 double enough) const {
  const Window window(polygon, normal);
  std::vector<std::int32_t> todo{start};
  std::vector<Vec3> part, room;
  Seen seen;
  seen.add(start);
  double highest = 0, turn = 0;
  while (!todo.empty()) {
    const std::int32_t t = todo.back();
    todo.pop_back();
    std::array<Vec3, 3> c;
    for (std::size_t i = 0; i < 3; ++i) c[i] = window.flat(vertices_[offset(triangles_[offset(t)][i])]);
    part.assign(c.begin(), c.end());
    window.clip(part, room);
    if (part.empty()) {
      if (t == start) return {};
      continue;
    }
    for (const Vec3& p : part) highest = std::max(highest, std::abs(p.z()));
    if (!(highest <= enough)) return {};
    const double area = (c[1].x() - c[0].x()) * (c[2].y() - c[0].y()) - (c[1].y() - c[0].y()) * (c[2].x() - c[0].x());
    const double longest = std::max({norm(c[1] - c[0]), norm(c[2] - c[1]), norm(c[0] - c[2])});
    if (t == start) turn = area < 0 ? -1 : 1;
    if (!(turn * area > upright * longest * longest)) return {};
    for (std::size_t i = 0; i < 3; ++i) {
      if (const std::int32_t next = beyond_[offset(t)][i]; next >= 0) {
        if (seen.add(next)) todo.push_back(next);
        continue;
      }
      part.assign({c[i], c[(i + 1) % 3]});
      window.clip(part, room);
      if (!part.empty()) return {};
    }
  }
  return highest;
}

}  // namespace carreau
