// SPDX-License-Identifier: BSD-3-Clause
// All-quadrilateral meshes: edges are cut in two, triangles in three, quadrilaterals in four.
#pragma once

#include <vector>

#include "surface/elements/quads/face_quads.h"

namespace carreau {

/// Cuts the edges of all curves in two, in `work.curves`, in the mesh and in curve_size. The result: by curve and edge
/// the new vertex of the mesh. Edges that narrow faces have left behind get the point of a face that they belong to.
std::vector<std::vector<std::int32_t>> halve_curves(const ElementWork& work, const std::vector<FaceQuads>& faces);

/// Cuts the cells of a face; new vertices inside are still to be lifted. Only quadrilaterals are left.
void halve_cells(const ElementWork& work, const std::vector<std::vector<std::int32_t>>& middles, FaceQuads& quads);

}  // namespace carreau
