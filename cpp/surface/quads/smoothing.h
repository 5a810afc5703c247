// SPDX-License-Identifier: BSD-3-Clause
// Vertices of quadrilaterals moved in the parameter plane.
#pragma once

#include <span>

#include "support/monitor.h"
#include "surface/quads/quad_patch.h"

namespace carreau {

class SpaceQuads;

struct QuadSmoothing {
  int passes = 17;
  double share = 1.4;     ///< of the way to the mean of the places that cells propose
  double momentum = 0.7;  ///< share of its last step that a vertex goes on; not in the last passes (plain_passes)
  double pull = 0.1;  ///< 0: cells keep their size; 1: they propose the size of unit edges
  /// Length of unit edges, in the metric.
  double unit = 1;
  /// Marks the vertices that may move; empty: all that are not fixed.
  std::span<const char> moving = {};
};

/// Each cell proposes to its corners the corners of the square or equilateral triangle that fits it best in the metric.
/// Each vertex that is not fixed goes towards the mean of proposals, with momentum (Polyak 1964), which carries strain
/// far in few passes. No cell that is convex turns over or gets flat.
void smooth_quads(QuadPatch& patch, const FaceCharts& charts, const QuadSmoothing& how, Monitor& monitor);
void smooth_quads(SpaceQuads& quads, const QuadSmoothing& how, Monitor& monitor);

/// Vertices of cells below `good`, worst first, go where the worst cell around is best.
void improve_worst_quads(QuadPatch& patch, const FaceCharts& charts, double good, Monitor& monitor);
void improve_worst_quads(SpaceQuads& quads, double good, Monitor& monitor);

}  // namespace carreau
