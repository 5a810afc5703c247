// SPDX-License-Identifier: BSD-3-Clause
// Reduces the number of vertices with more or fewer than four quadrilaterals around.
#pragma once

#include <functional>

#include "support/monitor.h"
#include "surface/quads/quad_patch.h"

namespace carreau {

class SpaceQuads;

/// Brings the numbers of cells around vertices nearer to their ideals: four inside, by the angle on curves. It removes
/// vertices of two cells, draws opposite corners of quadrilaterals together and turns edges between two quadrilaterals.
/// It also exchanges a triangle's place with a quadrilateral beside it. No edge leaves the allowed lengths, and no cell
/// becomes flat. Vertices that go belong to no cell afterwards. Smoothing between passes.
void clean_up(QuadPatch& patch, const FaceCharts& charts,
              const std::function<bool(std::int32_t, std::int32_t)>& is_imposed, Monitor& monitor);
void clean_up(SpaceQuads& quads, const std::function<bool(std::int32_t, std::int32_t)>& is_imposed, Monitor& monitor);

}  // namespace carreau
