// SPDX-License-Identifier: BSD-3-Clause
// Circumcentre insertion: points in triangles that are left too large.
#pragma once

#include "plane/placement/insertion.h"

namespace carreau::plane {

/// A point at the circumcentre of each triangle of a larger circumradius than `radius`, at least `distance` from all
/// vertices. In graded sizes, a lack or an excess of points changes the radius a little.
void insert_circumcentres(Placement& placement, double radius, double distance);

}  // namespace carreau::plane
