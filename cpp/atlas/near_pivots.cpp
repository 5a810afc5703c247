// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "atlas/pivots.h"
#include "predicates/predicates.h"

namespace carreau::atlas {
namespace {

/// Beside a vertex, on the side where its angle is below pi: +1 inside.
struct Beside {
  Vec2 place;
  int side;
  std::size_t vertex;
};

Vec2 unit(const Vec2& v) { return v / norm(v); }

/// Unit vector that halves the angle below pi at a vertex. Uses the formula without cancellation.
Vec2 bisector(const Vec2& before, const Vec2& at, const Vec2& after, int side) {
  const Vec2 in = unit(at - before), out = unit(after - at);
  const Vec2 along = in + out, across = out - in;
  return norm(along) > norm(across) ? Vec2(side * unit(Vec2(-along.y(), along.x()))) : unit(across);
}

}  // namespace

Pivots near_pivots(const Polygon& loop, const std::vector<double>& height, std::vector<std::size_t>& owner) {
  const std::size_t m = loop.size();
  std::vector<Beside> beside;
  for (std::size_t v = 0; v < m; ++v) {
    const Vec2 &before = loop[previous_of(v, m)], &after = loop[next_of(v, m)];
    const int side = orientation(before, loop[v], after);
    if (side != 0) beside.push_back({loop[v] + height[v] * bisector(before, loop[v], after, side), side, v});
  }
  // The chain begins inside.
  const auto first = std::find_if(beside.begin(), beside.end(), [](const Beside& b) { return b.side > 0; });
  std::rotate(beside.begin(), first, beside.end());
  Pivots pivots;
  owner.clear();
  const auto add = [&](const Vec2& place, std::size_t vertex) {
    pivots.place.push_back(place), owner.push_back(vertex);
  };
  for (std::size_t k = 0; k < beside.size(); ++k) {
    const Beside &b = beside[k], &next = beside[next_of(k, beside.size())];
    add(b.place, b.vertex);
    if (b.side != next.side) continue;
    const Vec2 edge = unit(loop[next.vertex] - loop[b.vertex]);
    const double h = std::min(height[b.vertex], height[next.vertex]);
    add((loop[b.vertex] + loop[next.vertex]) / 2 + (b.side * h) * Vec2(edge.y(), -edge.x()), b.vertex);
  }
  return pivots;
}

}  // namespace carreau::atlas
