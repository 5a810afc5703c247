// SPDX-License-Identifier: BSD-3-Clause
#include "atlas/polygon.h"

#include <algorithm>

#include "predicates/predicates.h"
#include "support/error.h"

namespace carreau::atlas {
namespace {

bool in_box(const Vec2& a, const Vec2& b, const Vec2& p) noexcept {
  return std::min(a.x(), b.x()) <= p.x() && p.x() <= std::max(a.x(), b.x()) && std::min(a.y(), b.y()) <= p.y() &&
         p.y() <= std::max(a.y(), b.y());
}

bool boxes_apart(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) noexcept {
  return std::max(a.x(), b.x()) < std::min(c.x(), d.x()) || std::max(c.x(), d.x()) < std::min(a.x(), b.x()) ||
         std::max(a.y(), b.y()) < std::min(c.y(), d.y()) || std::max(c.y(), d.y()) < std::min(a.y(), b.y());
}

std::string rank(std::size_t i) { return std::to_string(i + 1); }

[[noreturn]] void fail(std::string name, const std::string& rest, const Vec2& where) {
  throw DomainError(Where{.uv = where}, name + rest);
}

/// Squares and products of coordinates must not overflow.
constexpr double largest_coordinate = 1e100;

void require_edges(const Polygon& p, const std::string& name) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!is_finite(p[i]) || p[i].cwiseAbs().maxCoeff() > largest_coordinate)
      throw DomainError(name + " has a vertex " + rank(i) + " whose coordinates are not numbers below 1e100");
    const std::size_t j = next_of(i, p.size()), k = next_of(j, p.size());
    if (p[i] == p[j]) fail(name, " has the same place for its vertices " + rank(i) + " and " + rank(j), p[i]);
    if (orientation(p[i], p[j], p[k]) == 0 && dot(p[j] - p[i], p[k] - p[j]) < 0)
      fail(name, " turns back on itself at vertex " + rank(j), p[j]);
  }
}

}  // namespace

bool segments_cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) noexcept {
  if (boxes_apart(a, b, c, d)) return false;
  return orientation(a, b, c) * orientation(a, b, d) < 0 && orientation(c, d, a) * orientation(c, d, b) < 0;
}

bool segments_meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) noexcept {
  if (boxes_apart(a, b, c, d)) return false;
  const int abc = orientation(a, b, c), abd = orientation(a, b, d), cda = orientation(c, d, a),
            cdb = orientation(c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && in_box(a, b, c)) || (abd == 0 && in_box(a, b, d)) || (cda == 0 && in_box(c, d, a)) ||
         (cdb == 0 && in_box(c, d, b));
}

double crossing_share(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) noexcept {
  const Vec2 along = d - c;
  const double from_a = cross(along, a - c), from_b = cross(along, b - c);
  return from_a / (from_a - from_b);
}

bool is_inside(const Polygon& polygon, const Vec2& p) noexcept {
  bool inside = false;
  for (std::size_t i = 0, n = polygon.size(); i < n; ++i) {
    const Vec2 &a = polygon[i], &b = polygon[next_of(i, n)];
    const bool up = a.y() <= p.y() && b.y() > p.y(), down = b.y() <= p.y() && a.y() > p.y();
    const int side = up || down || in_box(a, b, p) ? orientation(a, b, p) : 1;
    if (side == 0 && in_box(a, b, p)) return false;
    if ((up && side > 0) || (down && side < 0)) inside = !inside;
  }
  return inside;
}

double signed_area(const Polygon& polygon) noexcept {
  double twice = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) twice += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return twice / 2;
}

void require_simple(const Polygon& polygon, const std::string& name) {
  const std::size_t n = polygon.size();
  if (n < 3) throw DomainError(name + " has " + std::to_string(n) + " vertices; a loop has three or more");
  require_edges(polygon, name);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 2; j < n; ++j)
      if (next_of(j, n) != i && segments_meet(polygon[i], polygon[i + 1], polygon[j], polygon[next_of(j, n)]))
        fail(name,
             " crosses or touches itself: its edge from vertex " + rank(i) + " meets the edge from vertex " + rank(j),
             polygon[i]);
  if (signed_area(polygon) <= 0)
    throw DomainError(name + " runs clockwise; vertex 1 and those after it must run counterclockwise");
}

void require_annulus(const Polygon& inner, const Polygon& outer) {
  const std::size_t n = inner.size(), m = outer.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < m; ++j)
      if (segments_meet(inner[i], inner[next_of(i, n)], outer[j], outer[next_of(j, m)]))
        fail("the annulus",
             " has no width where the edge of its inner border from vertex " + rank(i) +
                 " meets the edge of its outer border from vertex " + rank(j),
             inner[i]);
  if (!is_inside(outer, inner[0]))
    fail("the inner border", " is not inside the outer one: vertex 1 lies outside", inner[0]);
}

}  // namespace carreau::atlas
