// SPDX-License-Identifier: BSD-3-Clause
// Lines round a set of triangles, seen along an axis. Private to mesh/.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "support/vec.h"

namespace carreau {

/// A directed edge, the set on its left.
struct OutlineEdge {
  std::int32_t from, to;  ///< vertices
  Vec2 p, q;              ///< their places
};

/// Vertices from which more than one edge starts, ascending. Sorts the edges by their first vertices.
std::vector<std::int32_t> pinched_vertices(std::vector<OutlineEdge>& edges);

/// True if the edges, sorted and without pinched vertices, are closed simple lines without a common point, one
/// counterclockwise and all others clockwise. Returns false, too, if the test would take long. Exact.
bool goes_round_once(std::span<const OutlineEdge> edges);

}  // namespace carreau
