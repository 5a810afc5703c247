// SPDX-License-Identifier: BSD-3-Clause
// Swaps and moves that make triangles equilateral in the metric, and degrees six.
#pragma once

#include <cstddef>

#include "plane/kernel/plane_work.h"
#include "plane/kernel/settled.h"

namespace carreau::plane {

/// Leaves removed triangles without vertices (-1) and removed vertices without a triangle. `whole`: number of triangles
/// of the mesh, if this is a part of it. Returns the known states of the remaining triangles.
Settled optimise(PlaneWork& work, std::size_t whole = 0);

/// After place_squares(): the other passes prefer equilateral triangles, and halves of squares are not equilateral.
/// Flat triangles are raised.
void mend_squares(PlaneWork& work);

}  // namespace carreau::plane
