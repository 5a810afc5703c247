// SPDX-License-Identifier: BSD-3-Clause
#include "variable/transfer/overlaps.h"

#include <algorithm>

namespace carreau::variable {

namespace {

using Corners = std::array<Vec2, 3>;

Corners corners_of(const Piece& piece, std::size_t t) noexcept {
  const auto& v = piece.triangles[t];
  return {piece.vertices[static_cast<std::size_t>(v[0])], piece.vertices[static_cast<std::size_t>(v[1])],
          piece.vertices[static_cast<std::size_t>(v[2])]};
}

/// Does a side of p have all of q on its right?
bool is_apart(const Corners& p, const Corners& q) noexcept {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 a = p[k], d = p[(k + 1) % 3] - a;
    if (cross(d, q[0] - a) <= 0 && cross(d, q[1] - a) <= 0 && cross(d, q[2] - a) <= 0) return true;
  }
  return false;
}

/// A convex polygon of at most nine corners.
struct Polygon {
  std::array<Vec2, 9> corner;
  std::size_t size = 0;
  void add(const Vec2& p) noexcept {
    if (size < corner.size()) corner[size++] = p;
  }
};

/// The part of a polygon on the left of a -> b (Sutherland and Hodgman).
Polygon cut(const Polygon& polygon, const Vec2& a, const Vec2& b) noexcept {
  Polygon left;
  const Vec2 d = b - a;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const Vec2 p = polygon.corner[i], q = polygon.corner[i + 1 < polygon.size ? i + 1 : 0];
    const double sp = cross(d, p - a), sq = cross(d, q - a);
    if (sp >= 0) left.add(p);
    if ((sp > 0 && sq < 0) || (sp < 0 && sq > 0)) left.add(lerp(p, q, sp / (sp - sq)));
  }
  return left;
}

}  // namespace

Overlaps::Entry common_part(const Corners& p, const Corners& q) noexcept {
  Overlaps::Entry part;
  if (is_apart(p, q) || is_apart(q, p)) return part;
  Polygon polygon;
  for (const Vec2& corner : p) polygon.add(corner);
  for (std::size_t k = 0; k < 3; ++k) polygon = cut(polygon, q[k], q[(k + 1) % 3]);
  Vec2 moment{0, 0};  // about the first corner
  for (std::size_t i = 2; i < polygon.size; ++i) {
    const Vec2 d = polygon.corner[i - 1] - polygon.corner[0], e = polygon.corner[i] - polygon.corner[0];
    const double area = cross(d, e) / 2;
    part.area += area;
    moment += area / 3 * (d + e);
  }
  part.area = std::max(part.area, 0.0);
  if (part.area > 0) part.centre = polygon.corner[0] + moment / part.area;
  return part;
}

Overlaps overlaps_of(const Piece& old, const TriangleSearch& search, const Piece& piece) {
  Overlaps overlaps;
  std::vector<std::int32_t> near;
  for (std::size_t t = 0; t < piece.triangles.size(); ++t) {
    overlaps.start.push_back(overlaps.entries.size());
    const Corners corners = corners_of(piece, t);
    const Vec2 low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]),
               high = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]);
    near.clear();
    search.beside_box({low.x(), low.y(), 0}, {high.x(), high.y(), 0}, near);
    std::sort(near.begin(), near.end());
    for (const std::int32_t o : near) {
      Overlaps::Entry part = common_part(corners, corners_of(old, static_cast<std::size_t>(o)));
      part.old = o;
      if (part.area > 0) overlaps.entries.push_back(part);
    }
  }
  overlaps.start.push_back(overlaps.entries.size());
  return overlaps;
}

}  // namespace carreau::variable
