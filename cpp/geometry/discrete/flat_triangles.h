// SPDX-License-Identifier: BSD-3-Clause
// Removes triangles without area from a surface without opening it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/flat_mesh.h"

namespace carreau::discrete {

/// Triangles whose corners number vertices, with their attributes.
struct TriangleList {
  std::vector<std::array<std::int32_t, 3>>& triangles;
  std::vector<std::int32_t>& refs;
  std::vector<std::int32_t>& origin;
};

/// True when the height of a triangle is rounding (thresholds.h).
bool is_flat(std::span<const Vec3> vertices, const std::array<std::int32_t, 3>& triangle) noexcept;

/// Drops flat triangles, and returns the indices in `origin` of the dropped triangles, in the order of the work. The corner inside the
/// longest side of a flat triangle divides that side in all other triangles that have it, so that a closed surface stays closed. Corners
/// nearer to each other than rounding become one. Edges of `marked` are divided and joined likewise. Flat triangles are left when they do
/// not become fewer.
std::vector<std::int32_t> drop_flat_triangles(std::span<const Vec3> vertices, TriangleList list,
                                              std::vector<std::array<std::int32_t, 2>>& marked);

}  // namespace carreau::discrete
