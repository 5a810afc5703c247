// SPDX-License-Identifier: BSD-3-Clause
// Triangles that cannot cross each other, since they lie over a coordinate plane without covering any of it twice.
// Private to mesh/.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/crossings/views.h"
#include "support/monitor.h"
#include "support/vec.h"

namespace carreau {

/// By triangle of the mesh: the number of its graph, or -1. Two triangles of one graph have nothing in common but
/// vertices and edges that both have: seen along an axis all its triangles are turned alike, so that a place is covered
/// as often as the lines round the graph go round it (the degree of a map), and these are decided exactly to be simple,
/// one of them round all others. `views`: of all triangles. `order`: those that are asked about, neighbours near each
/// other: finite, with area, indices in range. They are looked at some ten thousands at a time, each share in one thread, and
/// stand there graph by graph afterwards. Throws Cancelled soon after `monitor` was asked to stop.
std::vector<std::int32_t> find_graphs(std::span<const Vec3> vertices,
                                      std::span<const std::array<std::int32_t, 3>> triangles,
                                      std::span<const TriangleView> views, std::span<std::int32_t> order, int threads,
                                      Monitor& monitor);

}  // namespace carreau
