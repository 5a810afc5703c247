// SPDX-License-Identifier: BSD-3-Clause
// Triangles without area. If straight edges cannot follow the field, a vertex put on an edge that is not swapped leaves
// a triangle between the edge and its two halves. Its lengths, each in a separate tensor, seem good, or better than any
// replacement. There the plane alone decides.
#pragma once

#include <cstdint>
#include <vector>

#include "plane/kernel/plane_work.h"

namespace carreau::plane {

/// Swaps or removes the triangles listed that are flat in the plane. Returns true if there was any.
bool raise_flat_triangles(PlaneWork& work, std::vector<std::int32_t> doubtful);

}  // namespace carreau::plane
