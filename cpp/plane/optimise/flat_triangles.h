// SPDX-License-Identifier: BSD-3-Clause
// Triangles without area. Where straight edges cannot follow the field, a vertex put on an edge that is not swapped
// leaves a triangle between the edge and its own halves, whose lengths, each by a tensor of its own, speak for it, or
// against all that could take its place. There the plane alone decides.
#pragma once

#include <cstdint>
#include <vector>

#include "plane/kernel/plane_work.h"

namespace carreau::plane {

/// Swaps or removes what is flat in the plane among the triangles listed. Whether there was any.
bool raise_flat_triangles(PlaneWork& work, std::vector<std::int32_t> doubtful);

}  // namespace carreau::plane
