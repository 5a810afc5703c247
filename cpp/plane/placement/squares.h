// SPDX-License-Identifier: BSD-3-Clause
// Places points for quadrilaterals, on a lattice of unit squares that follows a field of crosses.
#pragma once

#include "plane/placement/insertion.h"

namespace carreau::plane {

/// Layers of points from the imposed vertices on, each at unit distances along the crosses of the place that it comes
/// from; then circumcentres. Half of their squares are triangles of the mesh.
void place_squares(Placement& placement);

}  // namespace carreau::plane
