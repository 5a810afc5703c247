// SPDX-License-Identifier: BSD-3-Clause
// Requirements on a domain before its triangulation, and sentences about its edges.
#pragma once

#include <string>
#include <vector>

#include "mesh/plane_mesh.h"
#include "plane/kernel/frame.h"

namespace carreau::plane {

/// "edge 3 of curve 2 (vertices 17 and 18)"; counted from 1 as the host does for segments and curves, from 0 for
/// vertices.
std::string name_of(const PlaneEdge& edge);
/// The edge of the domain between these vertices, or "an imposed edge".
std::string name_of_edge_between(const PlaneDomain& domain, int u, int v);
[[noreturn]] void throw_at(const Vec2& uv, const std::string& sentence);

/// Throws DomainError unless vertices are finite, indices exist, and as many boundary edges arrive at each vertex as
/// leave it; LimitError when there are too many vertices for 32-bit half-edges.
void check_domain(const PlaneDomain& domain);

/// Frame of the box of the vertices. Throws DomainError when the box has no area.
Frame frame_of(const PlaneDomain& domain);

/// The vertices in an order that follows the edges from end to end.
std::vector<int> order_along_edges(const PlaneDomain& domain);

}  // namespace carreau::plane
