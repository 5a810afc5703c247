// SPDX-License-Identifier: BSD-3-Clause
// Triangles that cross each other, sought by many processes.
#pragma once

#include "mesh/crossings/intersections.h"
#include "support/ranks/crew.h"

namespace carreau {

/// find_intersections() by all processes of a team together: each process receives the whole result. `limit`: of
/// Intersections::pairs.
Intersections find_intersections(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
                                 std::size_t limit, const Crew& crew, Monitor& monitor);

/// Finds the pairs with at least one triangle in `asked` (by triangle, 1 or 0).
Intersections find_intersections_of(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
                                    const std::vector<char>& asked, std::size_t limit, int threads, Monitor& monitor);

}  // namespace carreau
