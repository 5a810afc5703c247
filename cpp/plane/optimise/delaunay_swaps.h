// SPDX-License-Identifier: BSD-3-Clause
// Swaps to the Delaunay criterion in the metric.
#pragma once

#include "plane/kernel/plane_work.h"
#include "plane/kernel/settled.h"

namespace carreau::plane {

/// Over the whole mesh, a bounded number of passes; then at long edges as many swaps as raise the smaller of two
/// smallest angles. In a field that bends, lengths of edges decide. Returns the settled states of the current triangles.
Settled swap_to_delaunay(PlaneWork& work);

/// Returns true if a triangle lower than a vertex has room has a long side that is not Delaunay in the metric.
bool has_leaning_strips(const PlaneWork& work);

}  // namespace carreau::plane
