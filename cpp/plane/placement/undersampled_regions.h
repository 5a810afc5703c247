// SPDX-License-Identifier: BSD-3-Clause
// Places of small sizes that lie amid triangles whose vertices do not know of them.
#pragma once

#include "plane/placement/insertion.h"

namespace carreau::plane {

/// Starts a mesh at such a place: a unit triangle, from whose sides layers continue as from a boundary. False: the
/// place is outside, or not far from all vertices.
bool seed_region(Placement& placement, Vec2 place);

}  // namespace carreau::plane
