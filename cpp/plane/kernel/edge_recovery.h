// SPDX-License-Identifier: BSD-3-Clause
// Makes an edge between two vertices of a triangulation exist.
#pragma once

#include "plane/kernel/triangulation.h"

namespace carreau::plane {

struct RecoveredEdge {
  HalfEdge edge = no_edge;     ///< of a triangle that has the edge, when it could be made
  int vertex = -1;             ///< otherwise: the vertex that lies on it,
  HalfEdge imposed = no_edge;  ///< alternatively, the imposed edge that it crosses (or the border)
};

/// Replaces the triangles that the segment from vertex a to vertex b crosses by triangles on both sides of it. Exact;
/// always ends. Vertices keep their numbers; triangles too, as a set. Leaves the triangulation as it was when the edge
/// cannot be made. `changed`, when given, receives the triangles that were rebuilt.
RecoveredEdge recover_edge(Triangulation& mesh, int a, int b, std::vector<std::int32_t>* changed = nullptr);

}  // namespace carreau::plane
