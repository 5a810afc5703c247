// SPDX-License-Identifier: BSD-3-Clause
// Swaps and moves that make triangles equilateral in the metric, and degrees six.
#pragma once

#include <cstddef>

#include "plane/kernel/plane_work.h"
#include "plane/kernel/settled.h"

namespace carreau::plane {

/// Leaves removed triangles without vertices (-1) and removed vertices without a triangle. `whole`: triangles of the mesh
/// of which this is a part, if it is more. Returns what is known of the triangles that are left.
Settled optimise(PlaneWork& work, std::size_t whole = 0);

/// After place_squares(): what the other passes look for is equilateral, and halves of squares are not. Flat triangles
/// are raised.
void mend_squares(PlaneWork& work);

}  // namespace carreau::plane
