// SPDX-License-Identifier: BSD-3-Clause
// Triangulations of the plane with given boundaries.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "support/vec.h"

namespace carreau {

/// Places of the vertices that are not known, as means of their neighbours with mean-value weights of the plane `from` (Floater 2003, eq.
/// 2.1). It reproduces affine maps, and it is one to one if the boundary of the known vertices is convex.
void map_harmonically(std::span<const Vec2> from, std::span<const std::array<std::int32_t, 3>> triangles, const std::vector<char>& known,
                      std::vector<Vec2>& to);

/// Moves vertices that are not fixed beside turned triangles until each is counterclockwise.
/// Returns the triangles that stay turned, ascending.
std::vector<std::int32_t> untangle(std::span<const std::array<std::int32_t, 3>> triangles, const std::vector<char>& fixed, std::vector<Vec2>& uv);

}  // namespace carreau
