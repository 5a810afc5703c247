// SPDX-License-Identifier: BSD-3-Clause
// Algebraic placement: points at unit distances on edges (RR-2928 sec. 2.2).
#pragma once

#include "plane/placement/insertion.h"

namespace carreau::plane {

/// On all edges longer than unity until there are none, then circumcentres.
void split_long_edges(Placement& placement);

}  // namespace carreau::plane
