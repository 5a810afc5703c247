// SPDX-License-Identifier: BSD-3-Clause
// Pivots: centres of polar bases that describe a loop piece by piece (Atlas sec. 5.2.2).
#pragma once

#include <vector>

#include "atlas/polygon.h"

namespace carreau::atlas {

/// A closed chain of pivots, counterclockwise: inside, outside, inside, ... A single pivot inside sees all of the loop.
struct Pivots {
  std::vector<Vec2> place;
  /// For each pivot outside, the point of the loop to which it may slide; meaningless for other pivots.
  std::vector<Vec2> anchor = {};
  /// Edge of the loop, by its first vertex, that the segment from pivot k to pivot k + 1 crosses; set by wrong_pivots.
  std::vector<std::size_t> crossed = {};

  [[nodiscard]] std::size_t size() const { return place.size(); }
  [[nodiscard]] bool is_inside(std::size_t k) const { return k % 2 == 0; }
};

/// How the pivots were found.
enum class PivotChoice {
  star,      ///< one: the loop is star-shaped about it
  skeleton,  ///< by the pseudo-skeleton
  near       ///< beside each vertex: serves every loop, with many pivots
};

/// Marks the pivots that break a condition of Atlas sec. 5.2.2.1, exactly. The segment between two pivots crosses the
/// loop once, at no vertex. The part of the loop between two crossings is star-shaped about its pivot. The chain does
/// not meet itself.
std::vector<char> wrong_pivots(const Polygon& loop, Pivots& pivots);

/// A point from which the whole loop is seen, about as far from the lines of its edges as can be; `room` is the least
/// of these distances over the extent of the loop. Not found: the loop is not star-shaped, or hardly.
struct StarCentre {
  bool found = false;
  Vec2 place{0, 0};
  double room = 0;
};
StarCentre star_centre(const Polygon& loop);

/// The least distance of a place from the lines of the edges, over the extent of the loop; 0 if it is outside of a
/// line.
double room_around(const Polygon& loop, const Vec2& place);

/// Pivots by the pseudo-skeleton: inner ones at ears and where the loop's turns change, outer ones between them, beyond
/// the outer border. Without an outer border (nullptr), they are beyond the loop. They may be wrong.
Pivots skeleton_pivots(const Polygon& loop, const Polygon* outer);

/// Pivots at `height[v]` beside each vertex v, and beyond the middles of edges between two that turn the same way.
/// Small heights make them right for every simple polygon. `owner` receives the vertices whose heights made each pivot.
Pivots near_pivots(const Polygon& loop, const std::vector<double>& height, std::vector<std::size_t>& owner);

struct ChosenPivots {
  Pivots pivots;
  PivotChoice how = PivotChoice::skeleton;
};

/// Pivots that meet all conditions. `star`: a single one is allowed. Throws DomainError with the vertex where no pivots
/// are found.
ChosenPivots choose_pivots(const Polygon& loop, const Polygon* outer, bool star);

}  // namespace carreau::atlas
