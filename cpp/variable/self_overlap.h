// SPDX-License-Identifier: BSD-3-Clause
// Finds places at which a displacement has pushed the piece through itself.
#pragma once

#include <cstdint>
#include <vector>

#include "variable/base/erosion.h"

namespace carreau::variable {

/// Remaining triangles whose boundary edges cross, or touch, boundary edges of triangles elsewhere; ascending. Exact. n
/// log n in boundary edges, if few are near each other.
std::vector<std::int32_t> crossing_triangles(const Eroded& eroded);

}  // namespace carreau::variable
