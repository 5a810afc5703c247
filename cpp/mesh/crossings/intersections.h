// SPDX-License-Identifier: BSD-3-Clause
// Triangles of a mesh that cross each other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "support/monitor.h"
#include "support/vec.h"

namespace carreau {

/// Two triangles that have a point in common which is on no vertex and no edge that both have.
struct TriangleIntersection {
  std::array<std::int32_t, 2> triangles{};  ///< ascending
  Vec3 place;                               ///< of such a point, as doubles have it
};

struct Intersections {
  std::int64_t count = 0;                   ///< of all pairs
  std::vector<TriangleIntersection> pairs;  ///< the first ones, ascending
};

struct IntersectionOptions {
  std::size_t limit = 1000;  ///< of Intersections::pairs
  int threads = 1;           ///< results do not depend on it
};

/// Decided exactly, in a time of the order of (n + count) log n. Vertices at one place are one vertex: edges that
/// faces have twice do not cross. Ignores triangles that find_defects reports: with an index out of range, a coordinate
/// that is not finite, or without area. Throws Cancelled soon after `monitor` received a request to stop.
Intersections find_intersections(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
                                 const IntersectionOptions& options, Monitor& monitor);

/// The test for two triangles with area; corners are one when their coordinates are equal. `place` is set when they
/// cross; may be null.
bool triangles_intersect(const std::array<Vec3, 3>& s, const std::array<Vec3, 3>& t, Vec3* place) noexcept;

}  // namespace carreau
