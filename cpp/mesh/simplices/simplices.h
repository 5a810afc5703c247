// SPDX-License-Identifier: BSD-3-Clause
// Tetrahedra, triangles and edges as one list, and the boundary of tetrahedra.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "support/vec.h"

namespace carreau {

/// A tetrahedron, triangle or edge: `corners` of them are used, vertices from 0.
struct Simplex {
  std::array<std::int32_t, 4> vertex{-1, -1, -1, -1};
  int corners = 0;  ///< 2, 3 or 4
};

/// Tetrahedra, triangles that are no face of these, edges that are no side of either: in this order, each list in its
/// order. The omitted simplices add no information to the larger ones. Corners of tetrahedra ascend, so that results that
/// depend on their order are equal on both sides of a face. Indices are not checked.
std::vector<Simplex> simplices_of(std::span<const std::array<std::int32_t, 4>> tetrahedra,
                                  std::span<const std::array<std::int32_t, 3>> triangles,
                                  std::span<const std::array<std::int32_t, 2>> edges);

/// The corners of the face opposite to each corner of a tetrahedron; turned inward for a positive volume.
inline constexpr std::array<std::array<std::size_t, 3>, 4> faces_of_tetrahedron{
    {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}}};

/// Six times the volume of a tetrahedron, positive if (b - a) x (c - a) points to d.
inline double volume6(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) noexcept {
  return dot(cross(b - a, c - a), d - a);
}

/// The faces of tetrahedra that only one of them has, turned outward; in the order of the tetrahedra.
std::vector<std::array<std::int32_t, 3>> boundary_of(std::span<const Vec3> vertices,
                                                     std::span<const std::array<std::int32_t, 4>> tetrahedra);

}  // namespace carreau
