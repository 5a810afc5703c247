// SPDX-License-Identifier: BSD-3-Clause
// Triangles that cross each other, sought by many processes.
#pragma once

#include "mesh/crossings/intersections.h"
#include "support/ranks/executor.h"

namespace carreau {

/// The triangles of face f are first[f] to first[f + 1] - 1. Vertices below `on_curves` are vertices of curves: triangles round any other
/// vertex of a sound mesh close.
struct FacesOfTriangles {
  std::span<const std::int32_t> first = {};
  std::int32_t on_curves = 0;
};

/// find_intersections() by the threads and processes of an executor together: each process receives the whole result. `limit`: of
/// Intersections::pairs. `faces`: only the time depends on them.
Intersections find_intersections(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
                                 std::size_t limit, const Executor& executor, Monitor& monitor, const FacesOfTriangles& faces = {});

/// Finds the pairs with at least one triangle in `asked` (by triangle, 1 or 0).
Intersections find_intersections_of(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
                                    const std::vector<char>& asked, std::size_t limit, int threads, Monitor& monitor);

}  // namespace carreau
