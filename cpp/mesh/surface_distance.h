// SPDX-License-Identifier: BSD-3-Clause
// How far one mesh is from another.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "support/monitor.h"
#include "support/vec.h"

namespace carreau {

/// The largest distance from the vertices, the middles of edges and those of triangles of one mesh to the triangles of
/// another one. 0 where one of them has none.
double largest_distance(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
                        std::span<const Vec3> to_vertices, std::span<const std::array<std::int32_t, 3>> to_triangles,
                        Monitor& monitor);

}  // namespace carreau
