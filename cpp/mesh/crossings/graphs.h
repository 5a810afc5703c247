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

/// For each triangle of the mesh: the number of its graph, or -1. Two triangles of one graph have only common vertices and
/// edges in common. Seen along an axis all its triangles have one orientation, so that a place is covered as often as the
/// lines round the graph go round it (the degree of a map). Exact tests decide that these lines are simple and that one of
/// them goes round all others. `views`: views of all triangles. `order`: the triangles to search, neighbours near each other:
/// finite, with area, indices in range. Searches shares of some ten thousand triangles, each in one thread, and sorts each
/// share by graph. Throws Cancelled soon after `monitor` received a request to stop.
std::vector<std::int32_t> find_graphs(std::span<const Vec3> vertices,
                                      std::span<const std::array<std::int32_t, 3>> triangles,
                                      std::span<const TriangleView> views, std::span<std::int32_t> order, int threads,
                                      Monitor& monitor);

/// Writes these numbers, counted from `first`, into `graph`, by triangle of the mesh, for the triangles of `order` alone.
void find_graphs_of(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
                    std::span<const TriangleView> views, std::span<std::int32_t> order, std::int32_t first,
                    std::span<std::int32_t> graph, int threads, Monitor& monitor);

}  // namespace carreau
