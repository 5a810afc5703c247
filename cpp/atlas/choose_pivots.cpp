// SPDX-License-Identifier: BSD-3-Clause
// Choice of pivots: one, the repaired pivots of the pseudo-skeleton, or pivots beside each vertex.
#include <algorithm>

#include "atlas/pivots.h"
#include "atlas/thresholds.h"
#include "support/error.h"
#include "support/rounding_of.h"

namespace carreau::atlas {
namespace {

bool any(const std::vector<char>& marks) { return std::find(marks.begin(), marks.end(), 1) != marks.end(); }

/// Drops an inner pivot and the outer one behind it where five pivots with two outer ones cross one another (Atlas
/// fig. 5.8).
bool drop_crossing(Pivots& pivots) {
  const std::size_t n = pivots.size();
  if (n <= 4) return false;
  for (std::size_t k = 0; k < n; k += 2) {
    const auto place = [&](std::size_t i) -> const Vec2& { return pivots.place[(k + i) % n]; };
    const bool crosses = segments_meet(place(0), place(1), place(2), place(3)) ||
                         segments_meet(place(1), place(2), place(3), place(4)) ||
                         segments_meet(place(0), place(1), place(3), place(4));
    if (!crosses) continue;
    const std::size_t gone = (k + 2) % n;  // even, and so is followed by its outer pivot
    const auto erase = [&](std::vector<Vec2>& list) {
      list.erase(list.begin() + static_cast<std::ptrdiff_t>(gone),
                 list.begin() + static_cast<std::ptrdiff_t>(gone) + 2);
    };
    erase(pivots.place), erase(pivots.anchor);
    return true;
  }
  return false;
}

/// Outer pivots that are wrong, or have wrong neighbours, slide towards the loop (Atlas fig. 5.9).
void slide(Pivots& pivots, const std::vector<char>& wrong) {
  const std::size_t n = pivots.size();
  for (std::size_t k = 1; k < n; k += 2)
    if (wrong[k] != 0 || wrong[k - 1] != 0 || wrong[(k + 1) % n] != 0)
      pivots.place[k] = lerp(pivots.place[k], pivots.anchor[k], 1 - thresholds::slide);
}

bool mend(const Polygon& loop, Pivots& pivots) {
  if (pivots.size() < 4) return false;
  Pivots dropped = pivots;
  while (drop_crossing(dropped)) {
  }
  for (Pivots* candidate : {&dropped, &pivots}) {
    for (int round = 0; round < thresholds::slides; ++round) {
      const std::vector<char> wrong = wrong_pivots(loop, *candidate);
      if (!any(wrong)) {
        if (candidate != &pivots) pivots = *candidate;
        return true;
      }
      slide(*candidate, wrong);
    }
  }
  return false;
}

/// Distance of a vertex from the parts of the loop that are not beside it, and the lengths of its edges.
double room_at(const Polygon& loop, std::size_t v) {
  const std::size_t m = loop.size();
  double room = std::min(norm(loop[v] - loop[previous_of(v, m)]), norm(loop[v] - loop[next_of(v, m)]));
  for (std::size_t e = 0; e < m; ++e) {
    if (e == v || next_of(e, m) == v) continue;
    const Vec2 edge = loop[next_of(e, m)] - loop[e];
    const double share = std::clamp(dot(loop[v] - loop[e], edge) / dot(edge, edge), 0.0, 1.0);
    room = std::min(room, norm(loop[v] - loop[e] - share * edge));
  }
  return room;
}

Pivots beside_vertices(const Polygon& loop) {
  constexpr double part_of_room = 0.5;
  std::vector<double> height(loop.size());
  for (std::size_t v = 0; v < loop.size(); ++v) height[v] = part_of_room * room_at(loop, v);
  std::vector<std::size_t> owner;
  std::size_t worst = 0;
  for (int round = 0; round < rounding_of::max_steps; ++round) {
    Pivots pivots = near_pivots(loop, height, owner);
    const std::vector<char> wrong = wrong_pivots(loop, pivots);
    if (!any(wrong)) return pivots;
    for (std::size_t k = 0; k < wrong.size(); ++k)
      if (wrong[k] != 0) height[worst = owner[k]] /= 2;
  }
  throw DomainError(Where{.uv = loop[worst]}, "no pivots describe the loop near vertex " + std::to_string(worst + 1) +
                                                  ": its parts are too near to one another there");
}

}  // namespace

ChosenPivots choose_pivots(const Polygon& loop, const Polygon* outer, bool star) {
  if (star)
    if (const StarCentre centre = star_centre(loop); centre.found) {
      ChosenPivots chosen{{{centre.place}}, PivotChoice::star};
      chosen.pivots.crossed = {0};
      return chosen;
    }
  Pivots pivots = skeleton_pivots(loop, outer);
  if (mend(loop, pivots)) return {std::move(pivots), PivotChoice::skeleton};
  return {beside_vertices(loop), PivotChoice::near};
}

}  // namespace carreau::atlas
