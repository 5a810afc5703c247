// SPDX-License-Identifier: BSD-3-Clause
// Triangles near triangles of other sets. Private to mesh/.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "support/monitor.h"
#include "support/vec.h"

namespace carreau {

/// Returns, in their order, the triangles of `numbers` whose boxes lie in cells of a grid with triangles of other sets; all pairs of different
/// sets with a common point are among them. `set`: by triangle of the mesh; -1: the triangle is a set of its own. Triangles are
/// finite. Returns all triangles if their sizes differ too much for a grid.
std::vector<std::int32_t> near_other_sets(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
                                          std::vector<std::int32_t> numbers, std::span<const std::int32_t> set, int threads,
                                          Monitor& monitor);

}  // namespace carreau
