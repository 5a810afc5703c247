// SPDX-License-Identifier: BSD-3-Clause
// Input and output of the plane mesher.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "support/vec.h"

namespace carreau {

enum class PlaneEdgeKind : std::int8_t {
  boundary,    ///< the domain lies on the left of a -> b
  internal,    ///< the domain lies on both sides
  degenerate,  ///< boundary that is one point in space: its metric length means nothing (HDR sec. 4.5.4)
};

/// An imposed edge between two imposed vertices.
struct PlaneEdge {
  int a = 0, b = 0;
  PlaneEdgeKind kind = PlaneEdgeKind::boundary;
  int curve = -1;    ///< index of the curve that it comes from (for messages and refinement)
  int segment = -1;  ///< rank of the edge on that curve
  /// For a degenerate edge: the least number of triangles that this domain must contribute around the point of space.
  int min_fan = 1;
  /// The least number for which all these triangles are at least half as wide as high.
  int wide_fan = 1;
};

/// A discretised parameter domain: closed loops of boundary edges (holes and several components are
/// allowed), internal edges, and vertices without an edge (imposed points).
struct PlaneDomain {
  std::vector<Vec2> vertices;
  std::vector<PlaneEdge> edges;
};

/// Triangles are counterclockwise. The imposed vertices come first, unmoved, in the order of PlaneDomain::vertices.
struct PlaneMesh {
  std::vector<Vec2> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;
};

}  // namespace carreau
