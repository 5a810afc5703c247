// SPDX-License-Identifier: BSD-3-Clause
// Where a displacement has pushed the piece through itself.
#pragma once

#include <cstdint>
#include <vector>

#include "variable/base/erosion.h"

namespace carreau::variable {

/// Triangles of what is left whose boundary edges cross, or touch, boundary edges of triangles elsewhere; ascending.
/// Exact. n log n in boundary edges where few are near each other.
std::vector<std::int32_t> crossing_triangles(const Eroded& eroded);

}  // namespace carreau::variable
