// SPDX-License-Identifier: BSD-3-Clause
// Swaps to the Delaunay criterion in the metric.
#pragma once

#include "plane/kernel/plane_work.h"
#include "plane/kernel/settled.h"

namespace carreau::plane {

/// Over the whole mesh, a bounded number of passes; then at long edges as many swaps as raise the smaller of two
/// smallest angles. Where the field bends by lengths of edges. Returns what is settled of the triangles as they are now.
Settled swap_to_delaunay(PlaneWork& work);

}  // namespace carreau::plane
