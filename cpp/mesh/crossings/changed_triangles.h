// SPDX-License-Identifier: BSD-3-Clause
// Finds crossing triangles in a mesh that shares many triangles with a previous mesh.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/crossings/intersections.h"
#include "support/monitor.h"
#include "support/ranks/executor.h"
#include "support/vec.h"

namespace carreau {

/// A mesh that was searched before. Triangles of `pairs` lie in range.
struct SearchedMesh {
  std::span<const Vec3> vertices;
  std::span<const std::array<std::int32_t, 3>> triangles;
  std::span<const TriangleIntersection> pairs;  ///< all that cross
};

/// Returns the result of find_intersections(), in less time if many triangles are as they were `before`: pairs of these are not
/// compared again.
Intersections find_intersections_again(const SearchedMesh& before, std::span<const Vec3> vertices,
                                       std::span<const std::array<std::int32_t, 3>> triangles, std::size_t limit,
                                       const Executor& executor, Monitor& monitor);

/// For each triangle: 1 if `before` has no identical triangle, corners compared to the last bit, or if that one crosses another. Each
/// triangle of `before` matches at most one triangle.
std::vector<char> changed_triangles(const SearchedMesh& before, std::span<const Vec3> vertices,
                                    std::span<const std::array<std::int32_t, 3>> triangles, Monitor& monitor);

/// For each triangle: 1 if it is in `asked`, or if its closed box has a point in common with the box of one in `asked`. Selects
/// all triangles if a search costs more. The result does not depend on the number of threads.
std::vector<char> near_triangles(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
                                 const std::vector<char>& asked, int threads, Monitor& monitor);

}  // namespace carreau
