// SPDX-License-Identifier: BSD-3-Clause
// The elements of a face, divided at the middles of their edges.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "association/mesh_edges.h"

namespace carreau::refining {

/// The shape (Q2) of a triangle of local vertices; -1 if it is turned in (u, v).
double shape_of(const FaceMesh& face, const Triangle& triangle, const std::vector<Vec3>& vertices);

/// Divides the elements of a face. `edges`: of its elements by local vertices, `middle`: the local vertex on each, -1 if it is whole.
/// `add_centre(uv)` makes a local vertex in a quadrilateral, `place_centres(list)` gives these their positions in `vertices`. A triangle
/// of three halved edges becomes four, a quadrilateral of four becomes four, others become triangles. Returns for each new triangle the
/// shape of the triangle before, and min_shape() of the quadrilateral before for both halves of a quadrilateral.
std::vector<float> divide_elements(FaceMesh& face, const EdgeList& edges, std::span<const std::int32_t> middle, const std::vector<Vec3>& vertices,
                                   const std::function<std::int32_t(const Vec2&)>& add_centre,
                                   const std::function<void(std::span<const std::int32_t>)>& place_centres);

}  // namespace carreau::refining
