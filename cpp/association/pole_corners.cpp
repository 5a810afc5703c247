// SPDX-License-Identifier: BSD-3-Clause
#include "association/pole_corners.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "association/mesh_edges.h"

namespace carreau::refining {

namespace {

/// A corner of an element at a pole, and its neighbours in the element.
struct PoleCorner {
  std::size_t triangle;  ///< the first one, of a quadrilateral
  std::int32_t previous, next;
};

using Corners = std::map<std::int32_t, std::vector<PoleCorner>>;

Corners corners_at(const FaceMesh& face, const Poles& poles) {
  Corners corners;
  const auto quads = static_cast<std::size_t>(face.quads);
  const auto add = [&](std::size_t triangle, std::span<const std::int32_t> cell) {
    for (std::size_t k = 0, n = cell.size(); k < n; ++k)
      if (poles.contains(face.vertex[cell[k]])) corners[cell[k]].push_back({triangle, cell[(k + n - 1) % n], cell[(k + 1) % n]});
  };
  for (std::size_t k = 0; k < quads; ++k) add(2 * k, face.quad(k));
  for (std::size_t t = 2 * quads; t < face.triangles.size(); ++t) add(t, face.triangles[t]);
  return corners;
}

/// Orders corners so that the next side of each is the previous side of the following one. Returns false if they are no such chain.
bool order(std::vector<PoleCorner>& corners) {
  const auto first = std::find_if(corners.begin(), corners.end(), [&](const PoleCorner& c) {
    return std::none_of(corners.begin(), corners.end(), [&](const PoleCorner& other) { return other.next == c.previous; });
  });
  if (first == corners.end()) return false;
  std::iter_swap(corners.begin(), first);
  for (auto now = corners.begin(); now + 1 != corners.end(); ++now) {
    const auto after = std::find_if(now + 1, corners.end(), [&](const PoleCorner& c) { return c.previous == now->next; });
    if (after == corners.end()) return false;
    std::iter_swap(now + 1, after);
  }
  return true;
}

}  // namespace

void part_poles(FaceMesh& face, const Poles& poles, std::span<const CurveSide> sides) {
  if (poles.empty()) return;
  for (auto& at_pole : corners_at(face, poles)) {
    const std::int32_t a = at_pole.first;
    std::vector<PoleCorner>& corners = at_pole.second;
    const std::int32_t pole = face.vertex[a];
    const Vec2 home = face.uv[a];
    const auto place = [&](std::int32_t v) { return poles.arrival(a, face.uv[v]); };
    const auto is_between = [&](const PoleCorner& c) {
      const Vec2 p = place(c.previous), q = place(c.next), low = p.cwiseMin(q), high = p.cwiseMax(q);
      return low.x() <= home.x() && home.x() <= high.x() && low.y() <= home.y() && home.y() <= high.y();
    };
    const auto is_curve = [&](std::int32_t v) {
      return std::any_of(sides.begin(), sides.end(), [&](const CurveSide& s) { return (s.a == a && s.b == v) || (s.b == a && s.a == v); });
    };
    if (corners.empty() || std::all_of(corners.begin(), corners.end(), is_between)) continue;
    const auto joins_poles = [&](const PoleCorner& c) { return face.vertex[c.previous] == pole || face.vertex[c.next] == pole; };
    if (std::any_of(corners.begin(), corners.end(), joins_poles) || !order(corners)) continue;
    if (std::any_of(corners.begin(), corners.end() - 1, [&](const PoleCorner& c) { return is_curve(c.next); })) continue;
    // The corner at a curve keeps the vertex, which is an end of the side; without a curve the first one, at another place.
    const bool at_first = is_curve(corners.front().previous), at_last = is_curve(corners.back().next);
    const std::size_t keeps = at_last ? corners.size() - 1 : 0;
    std::vector<std::int32_t> own;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec2 middle = 0.5 * (place(corners[k].previous) + place(corners[k].next));
      if (k == keeps) {
        own.push_back(a);
        if (!at_first && !at_last) face.uv[a] = middle;
        continue;
      }
      own.push_back(static_cast<std::int32_t>(face.uv.size()));
      face.uv.push_back(middle), face.vertex.push_back(pole);
      const std::size_t t = corners[k].triangle;
      for (std::size_t half = t; half < t + (t < 2 * static_cast<std::size_t>(face.quads) ? 2 : 1); ++half)
        std::replace(face.triangles[half].begin(), face.triangles[half].end(), a, own.back());
    }
    for (Triangle& t : face.flattened) {
      const auto has = [&](std::int32_t v) { return std::find(t.begin(), t.end(), v) != t.end(); };
      if (!has(a)) continue;
      if (has(corners.front().previous)) std::replace(t.begin(), t.end(), a, own.front());
      if (has(corners.back().next)) std::replace(t.begin(), t.end(), a, own.back());
    }
    for (std::size_t k = 0; k + 1 < corners.size(); ++k) face.flattened.push_back({own[k], own[k + 1], corners[k].next});
  }
}

}  // namespace carreau::refining
