// SPDX-License-Identifier: BSD-3-Clause
// Triangles that passes over the whole mesh have left bad or crowded, one by one.
#pragma once

#include <cstdint>
#include <vector>

#include "plane/kernel/plane_work.h"
#include "plane/kernel/settled.h"

namespace carreau::plane {

/// Removes vertices of edges that are much too short, if that makes no triangle bad. Leaves removed triangles in the
/// list.
void remove_crowded_vertices(PlaneWork& work);

/// Improves bad triangles, left at meetings of layers or at jumps of sizes, and crowded ones: moves, swaps, removals
/// and insertions that each improve the triangles that they touch. Returns the tested triangles: all others are good.
/// `settled`: the state of the triangles, before and after.
std::vector<std::int32_t> mend_bad_triangles(PlaneWork& work, Settled& settled);

}  // namespace carreau::plane
