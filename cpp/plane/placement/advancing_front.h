// SPDX-License-Identifier: BSD-3-Clause
// Points placed layer by layer from the boundary.
#pragma once

#include "plane/placement/insertion.h"

namespace carreau::plane {

/// Layers (README) until nothing is left between the fronts, then circumcentres. May be called again, after
/// seed_region().
void advance_front(Placement& placement);

}  // namespace carreau::plane
