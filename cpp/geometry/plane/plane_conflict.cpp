// SPDX-License-Identifier: BSD-3-Clause
// Conflicts of polylines that should not meet.
#include <algorithm>

#include "geometry/plane/plane_graph.h"
#include "predicates/predicates.h"

namespace carreau {

namespace {

struct Segment {
  int a = 0, b = 0, arc = 0;
};

bool in_box(const Vec2& a, const Vec2& b, const Vec2& p) noexcept {
  return p.x() >= std::min(a.x(), b.x()) && p.x() <= std::max(a.x(), b.x()) && p.y() >= std::min(a.y(), b.y()) &&
         p.y() <= std::max(a.y(), b.y());
}

/// A common point that is not a vertex of both.
std::optional<Vec2> common_point(const std::vector<Vec2>& v, const Segment& e, const Segment& f) {
  const Vec2 &a = v[e.a], &b = v[e.b], &c = v[f.a], &d = v[f.b];
  const bool at_a = e.a == f.a || e.a == f.b, at_b = e.b == f.a || e.b == f.b;
  if (at_a && at_b) return Vec2(lerp(a, b, 0.5));
  if (at_a || at_b) {
    const int shared = at_a ? e.a : e.b;
    const Vec2 &s = v[shared], &p = at_a ? b : a, &q = f.a == shared ? d : c;
    if (orientation(s, p, q) != 0 || dot(Vec2(p - s), Vec2(q - s)) < 0) return std::nullopt;
    return norm(Vec2(p - s)) < norm(Vec2(q - s)) ? p : q;
  }
  const int oc = orientation(a, b, c), od = orientation(a, b, d), oa = orientation(c, d, a), ob = orientation(c, d, b);
  if (oc * od < 0 && oa * ob < 0) {
    const Vec2 ab = b - a, cd = d - c;
    return Vec2(a + (cross(Vec2(c - a), cd) / cross(ab, cd)) * ab);
  }
  if (oc == 0 && in_box(a, b, c)) return c;
  if (od == 0 && in_box(a, b, d)) return d;
  if (oa == 0 && in_box(c, d, a)) return a;
  if (ob == 0 && in_box(c, d, b)) return b;
  return std::nullopt;
}

}  // namespace

std::optional<ArcConflict> PlaneGraph::find_conflict(const PlaneDomainInput& input, std::span<const PlaneArc> arcs) {
  std::vector<Vec2> vertices;
  std::vector<Segment> segments;
  for (const PlanePoint& point : input.points) vertices.push_back(point.xy);
  for (std::size_t i = 0; i < arcs.size(); ++i)
    for (std::size_t k = 1, before = static_cast<std::size_t>(arcs[i].from); k < arcs[i].polyline.size(); ++k) {
      std::size_t here = static_cast<std::size_t>(arcs[i].to);
      if (k + 1 < arcs[i].polyline.size()) here = vertices.size(), vertices.push_back(arcs[i].polyline[k]);
      segments.push_back({static_cast<int>(before), static_cast<int>(here), static_cast<int>(i)});
      before = here;
    }
  if (segments.empty()) return std::nullopt;
  std::vector<std::pair<int, int>> pairs;
  for (const Segment& s : segments) pairs.emplace_back(s.a, s.b);
  const EdgeGrid grid(vertices, pairs);
  std::optional<std::pair<int, int>> first;
  Vec2 at;
  for (int row = 0; row < grid.rows(); ++row)
    for (int column = 0; column < grid.columns(); ++column) {
      const std::span<const int> here = grid.edges_in(column, row);
      for (std::size_t i = 0; i < here.size(); ++i)
        for (std::size_t j = i + 1; j < here.size(); ++j) {
          const std::pair<int, int> both = std::minmax(here[i], here[j]);
          if (first && *first <= both) continue;
          if (const auto p = common_point(vertices, segments[both.first], segments[both.second])) first = both, at = *p;
        }
    }
  if (!first) return std::nullopt;
  return ArcConflict{segments[first->first].arc, segments[first->second].arc, at};
}

}  // namespace carreau
