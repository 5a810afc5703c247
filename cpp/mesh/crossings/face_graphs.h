// SPDX-License-Identifier: BSD-3-Clause
// Whole faces whose triangles cannot cross each other, since they lie over a coordinate plane without covering any of it
// twice. Private to mesh/.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "mesh/crossings/shared_search.h"
#include "mesh/crossings/views.h"
#include "support/monitor.h"
#include "support/vec.h"

namespace carreau {

/// Gives the triangles of each face that is a graph (find_graphs()) its number in `graph`, by triangle of the mesh; some triangles may
/// be left out of their face's graph, and keep -1. Returns the number of graphs. A place is covered as often as the lines round the
/// triangles go round it. These lines are the edges between vertices on curves that two triangles do not cancel. Sums of hashed neighbours
/// show that the triangles round every other vertex close (an error has a chance of 2^-64 for each vertex).
/// `views`: views of all triangles.
std::int32_t find_face_graphs(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
                              std::span<const TriangleView> views, const FacesOfTriangles& faces,
                              std::span<std::int32_t> graph, int threads, Monitor& monitor);

}  // namespace carreau
