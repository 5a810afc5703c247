// SPDX-License-Identifier: BSD-3-Clause
// Sizes prescribed by the geometry of the boundary: H_g of HDR sec. 3.4.1.
#pragma once

#include <vector>

#include "gradation/edge_sizes.h"
#include "variable/boundary/run_curve.h"

namespace carreau::variable {

/// A loop with its runs and their curves.
struct BoundaryShape {
  BoundaryLoop loop;
  std::vector<BoundaryRun> runs;
  std::vector<RunCurve> curves;  ///< of the runs; refer to loop and runs: do not move them
};

struct BoundarySizes {
  /// Sizes of the piece's vertices, +infinity if nothing is prescribed: free nodes 2 sin(angle) times the radius of
  /// curvature of the new boundary; imposed ones the mean length of the adjacent edges.
  std::vector<double> at_vertices;
  /// Along bound edges: 2 sin(angle) times the radius of the tool's arcs there.
  std::vector<EdgeSizes::Source> along_tools;
};

/// `angle`: between an edge and the tangents at its ends, degrees. Sizes are at least h_min.
BoundarySizes boundary_sizes(const std::vector<BoundaryShape>& shapes, const Tools& tools, std::size_t vertices,
                             double angle, double h_min);

}  // namespace carreau::variable
