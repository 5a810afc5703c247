// SPDX-License-Identifier: BSD-3-Clause
// The pseudo-skeleton of a polygon: a wall inside it, and places of inner pivots (Atlas sec. 5.2.2.2).
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "atlas/polygon.h"

namespace carreau::atlas {

/// Triangles without new points, corners counterclockwise, indices of vertices. The ear whose smallest angle is largest
/// is cut first, which avoids slivers if possible. Polygons are simple (require_simple).
std::vector<std::array<std::size_t, 3>> triangulate(const Polygon& polygon);

struct PseudoSkeleton {
  std::vector<std::array<std::size_t, 3>> triangles;
  std::vector<std::pair<Vec2, Vec2>> edges;
  /// For each edge of the polygon, the place that faces it: the barycentre of its ear. Without an ear, the middle of
  /// the skeleton's edge that is parallel to it.
  std::vector<Vec2> facing;
  std::vector<std::size_t> ears;  ///< their tips, ascending
};

PseudoSkeleton pseudo_skeleton(const Polygon& polygon);

}  // namespace carreau::atlas
