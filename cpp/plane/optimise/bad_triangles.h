// SPDX-License-Identifier: BSD-3-Clause
// Triangles that passes over the whole mesh have left bad or crowded, one by one.
#pragma once

#include <cstdint>
#include <vector>

#include "plane/kernel/plane_work.h"
#include "plane/kernel/settled.h"

namespace carreau::plane {

/// Removes vertices of edges much too short, where that makes no triangle bad. Leaves removed triangles in the list.
void remove_crowded_vertices(PlaneWork& work);

/// Bad triangles, left where layers met or where sizes jump, and crowded ones: moves, swaps, removals and insertions
/// that each make what they touch better. Returns the triangles that were looked at: all others are good. `settled`: what
/// is known of the triangles, before and after.
std::vector<std::int32_t> mend_bad_triangles(PlaneWork& work, Settled& settled);

}  // namespace carreau::plane
