// SPDX-License-Identifier: BSD-3-Clause
// The starting places of the layers that reach a place.
#pragma once

#include <cstdint>
#include <vector>

#include "plane/division/coarse_domain.h"
#include "plane/division/partition.h"

namespace carreau::plane {

/// Returns, for each triangle of the coarse mesh, the place on the imposed edges from which layers reach its centroid
/// first, counted from edge to edge and from loop to loop. It is the start of the characteristic of the eikonal
/// equation in the coarse metric, by fast marching (Kimmel and Sethian 1998, "Computing geodesic paths on manifolds").
/// No layers start at degenerate sides.
std::vector<double> arrivals(const CoarseMesh& coarse, const CoarseDomain& domain);

}  // namespace carreau::plane
