// SPDX-License-Identifier: BSD-3-Clause
// Triangles that are left walk through quadrilaterals until two meet.
#pragma once

#include <functional>

#include "support/monitor.h"
#include "surface/quads/quad_patch.h"

namespace carreau {

class SpaceQuads;

/// For each triangle the nearest other one (by cells on the way, across edges that are not imposed): the pentagon of
/// the triangle and the quadrilateral beside it is cut anew, so that the triangle lies one cell farther on, and so on;
/// in the end the two become a quadrilateral. Ways on which a cell would get flat are left. Two triangles and n
/// quadrilaterals become n + 1.
void join_triangles(QuadPatch& patch, const FaceCharts& charts,
                    const std::function<bool(std::int32_t, std::int32_t)>& is_imposed, Monitor& monitor);
void join_triangles(SpaceQuads& quads, const std::function<bool(std::int32_t, std::int32_t)>& is_imposed,
                    Monitor& monitor);

}  // namespace carreau
