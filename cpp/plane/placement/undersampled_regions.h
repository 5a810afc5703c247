// SPDX-License-Identifier: BSD-3-Clause
// Places of small sizes that lie amid triangles whose vertices do not know of them.
#pragma once

#include "plane/placement/insertion.h"

namespace carreau::plane {

/// Starts a mesh at such a place: a unit triangle, from whose sides layers continue as from a boundary. False: the
/// place is outside, or not far from all vertices. `hint`: a triangle where the search for the place starts; becomes the
/// place's triangle if there is one.
bool seed_region(Placement& placement, Vec2 place, int& hint);

}  // namespace carreau::plane
