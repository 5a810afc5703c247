// SPDX-License-Identifier: BSD-3-Clause
// Triangles that cross in a mesh many of whose triangles another one had, too.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/crossings/intersections.h"
#include "support/monitor.h"
#include "support/ranks/crew.h"
#include "support/vec.h"

namespace carreau {

/// A mesh that was searched before. Triangles of `pairs` lie in range.
struct SearchedMesh {
  std::span<const Vec3> vertices;
  std::span<const std::array<std::int32_t, 3>> triangles;
  std::span<const TriangleIntersection> pairs;  ///< all that cross
};

/// What find_intersections() says, in less time where many triangles are as they were `before`: pairs of these are not asked again.
Intersections find_intersections_again(const SearchedMesh& before, std::span<const Vec3> vertices,
                                       std::span<const std::array<std::int32_t, 3>> triangles, std::size_t limit,
                                       const Crew& crew, Monitor& monitor);

/// By triangle: 1 where `before` has none with corners at the same places, to the last bit, or where that crosses another one. Each triangle
/// of `before` is the same as one at most.
std::vector<char> changed_triangles(const SearchedMesh& before, std::span<const Vec3> vertices,
                                    std::span<const std::array<std::int32_t, 3>> triangles, Monitor& monitor);

/// By triangle: 1 where it is one of `asked`, or its closed box has a point in common with that of one. All of them where that is
/// not worth a search. The same for any number of threads.
std::vector<char> near_triangles(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
                                 const std::vector<char>& asked, int threads, Monitor& monitor);

}  // namespace carreau
