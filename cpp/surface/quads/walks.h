// SPDX-License-Identifier: BSD-3-Clause
// Moves remaining triangles through quadrilaterals until two meet.
#pragma once

#include <functional>

#include "support/monitor.h"
#include "surface/quads/quad_patch.h"

namespace carreau {

class SpaceQuads;

/// Joins each triangle with the nearest other triangle (by cells on the way, across edges that are not imposed). The
/// pentagon of a triangle and the quadrilateral beside it is cut anew, so that the triangle lies one cell farther on,
/// and so on. At the end the two triangles become a quadrilateral. Ways on which a cell would become flat are left out.
/// Two triangles and n quadrilaterals become n + 1.
void join_triangles(QuadPatch& patch, const FaceCharts& charts,
                    const std::function<bool(std::int32_t, std::int32_t)>& is_imposed, Monitor& monitor);
void join_triangles(SpaceQuads& quads, const std::function<bool(std::int32_t, std::int32_t)>& is_imposed,
                    Monitor& monitor);

}  // namespace carreau
