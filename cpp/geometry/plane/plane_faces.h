// SPDX-License-Identifier: BSD-3-Clause
// Selects the faces of a plane graph that are subdomains.
#pragma once

#include <vector>

#include "geometry/plane/plane_graph.h"

namespace carreau {

struct Subdomain {
  int face = 0;  ///< of the graph
  int ref = 0;   ///< the user's; 0: none
};

/// In the order of their references' first appearance; subdomains with equal references (but 0) follow one another.
/// Throws InvalidModel as described at build_plane_geometry().
std::vector<Subdomain> find_subdomains(const PlaneDomainInput& input, std::span<const PlaneArc> arcs,
                                       const PlaneGraph& graph);

}  // namespace carreau
