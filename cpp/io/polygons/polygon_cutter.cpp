// SPDX-License-Identifier: BSD-3-Clause
#include "io/polygons/polygon_cutter.h"

#include <cmath>

namespace carreau {

namespace {

/// Ears are searched in time that grows with the square; real files have polygons of tens of corners.
constexpr std::size_t max_corners = 4096;
/// In polygons with more corners, the first ear is cut.
constexpr std::size_t few_corners = 32;

double doubled_area(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

bool inside(const Vec2& p, const Vec2& a, const Vec2& b, const Vec2& c) {
  return doubled_area(a, b, p) >= 0 && doubled_area(b, c, p) >= 0 && doubled_area(c, a, p) >= 0;
}

/// Twice the area over the sum of the squares of the sides: a constant times the shape quality, with the sign of turn.
double shape(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double sides = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return sides > 0 ? doubled_area(a, b, c) / sides : 0;
}

}  // namespace

std::string PolygonCutter::add(std::span<const std::int32_t> corners, std::int32_t ref) {
  if (corners.size() < 3) return "a polygon has " + std::to_string(corners.size()) + " corners";
  if (corners.size() > max_corners)
    return "a polygon has " + std::to_string(corners.size()) + " corners; " + std::to_string(max_corners) +
           " are the most that are cut";
  for (const std::int32_t v : corners)
    if (v < 0 || static_cast<std::size_t>(v) >= mesh_.vertices.size())
      return "a polygon names vertex " + std::to_string(v) + " (from 0) of " + std::to_string(mesh_.vertices.size());
  if (corners.size() == 3) {
    mesh_.triangles.push_back({corners[0], corners[1], corners[2]});
    mesh_.triangle_refs.push_back(ref);
  } else {
    cut(corners, ref);
  }
  return "";
}

void PolygonCutter::cut(std::span<const std::int32_t> corners, std::int32_t ref) {
  const auto point = [&](std::size_t i) -> const Vec3& {
    return mesh_.vertices[static_cast<std::size_t>(corners[i % corners.size()])];
  };
  // The vector area, whose direction is the best plane's (Newell).
  Vec3 area = Vec3::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i) area += cross(point(i) - point(0), point(i + 1) - point(0));
  Eigen::Index axis = 0;
  area.cwiseAbs().maxCoeff(&axis);
  const double turn = area[axis] < 0 ? -1 : 1;
  plane_.clear();
  left_.clear();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 d = point(i) - point(0);
    plane_.emplace_back(d[(axis + 1) % 3], turn * d[(axis + 2) % 3]);
    left_.push_back(static_cast<std::int32_t>(i));
  }
  while (left_.size() >= 3) {
    const std::size_t n = left_.size();
    const auto at = [&](std::size_t i) { return static_cast<std::size_t>(left_[i % n]); };
    std::size_t best = 0;
    double best_shape = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2 &a = plane_[at(i + n - 1)], &b = plane_[at(i)], &c = plane_[at(i + 1)];
      const double s = shape(a, b, c);
      if (s <= best_shape) continue;
      bool ear = true;
      for (std::size_t k = 2; k + 1 < n && ear; ++k) {
        const Vec2& p = plane_[at(i + k)];
        ear = !inside(p, a, b, c) || p == a || p == b || p == c;
      }
      if (!ear) continue;
      best = i;
      best_shape = s;
      if (n > few_corners) break;
    }
    // Without an ear, which flat or crossing polygons may lack, any corner is cut off.
    const auto vertex = [&](std::size_t i) { return corners[at(i)]; };
    mesh_.triangles.push_back({vertex(best + n - 1), vertex(best), vertex(best + 1)});
    mesh_.triangle_refs.push_back(ref);
    left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(best));
  }
}

}  // namespace carreau
