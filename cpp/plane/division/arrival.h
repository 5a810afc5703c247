// SPDX-License-Identifier: BSD-3-Clause
// Where the layers that reach a place have started.
#pragma once

#include <cstdint>
#include <vector>

#include "plane/division/coarse_domain.h"
#include "plane/division/partition.h"

namespace carreau::plane {

/// By triangle of the coarse mesh: the place on the imposed edges, counted from edge to edge and from loop to loop,
/// from which layers reach its centroid first: the characteristic of the eikonal equation in the coarse metric that
/// ends there, by fast marching (Kimmel and Sethian 1998, "Computing geodesic paths on manifolds"). No layers start at
/// degenerate sides.
std::vector<double> arrivals(const CoarseMesh& coarse, const CoarseDomain& domain);

}  // namespace carreau::plane
