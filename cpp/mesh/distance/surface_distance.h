// SPDX-License-Identifier: BSD-3-Clause
// The distance of one mesh from another.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "support/monitor.h"
#include "support/ranks/executor.h"
#include "support/vec.h"

namespace carreau {

/// Triangles of space: indices lie in range, coordinates are finite.
struct TrianglesOfSpace {
  std::span<const Vec3> vertices;
  std::span<const std::array<std::int32_t, 3>> triangles;
};

/// The largest distance to the triangles of the second mesh from the vertices, the middles of edges and the middles of
/// triangles of the first mesh. 0 if one of them has no triangles. The result does not depend on the executor.
double largest_distance(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
                        std::span<const Vec3> to_vertices, std::span<const std::array<std::int32_t, 3>> to_triangles,
                        Monitor& monitor, const Executor& executor = {});

/// Bounds of the largest distance from all points of one mesh to a second mesh, rounding included.
struct DistanceBounds {
  double lower = 0, upper = 0;
};

/// A point of a triangle, and the point nearest to it of another mesh.
struct FarPoint {
  Vec3 at{};
  double distance = 0;
  std::int32_t nearest = 0;  ///< triangle of the other mesh
};

/// Required accuracy of the bounds.
struct DistanceTolerance {
  double share = 0.01;   ///< of the distance
  double length = 1e-6;  ///< added to the share, as a share of the diagonal of the box of `to`
};

/// The distance to a single triangle is convex: over a convex polygon it is largest at a corner. Triangles are cut, beside
/// the triangles that are nearest and then in halves, until one triangle of `to` shows of each piece that it is near
/// enough. If that takes too many pieces, returns the upper bound reached. `of_triangles`, unless it is null, receives an upper bound for
/// each triangle, and `farthest` the farthest of its corners and its middle. Both 0 if one of the meshes has no triangles. The result does
/// not depend on the executor. Throws Cancelled.
DistanceBounds bound_distance(const TrianglesOfSpace& from, const TrianglesOfSpace& to, const DistanceTolerance& tolerance,
                              const Executor& executor, Monitor& monitor, std::vector<double>* of_triangles = nullptr,
                              std::vector<FarPoint>* farthest = nullptr);
inline DistanceBounds bound_distance(const TrianglesOfSpace& from, const TrianglesOfSpace& to, const DistanceTolerance& tolerance,
                                     int threads, Monitor& monitor, std::vector<double>* of_triangles = nullptr) {
  return bound_distance(from, to, tolerance, Executor{nullptr, threads}, monitor, of_triangles);
}

}  // namespace carreau
