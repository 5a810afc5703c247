// SPDX-License-Identifier: BSD-3-Clause
// Triangles joined two by two (HDR sec. 3.3.4).
#pragma once

#include <functional>
#include <vector>

#include "support/monitor.h"
#include "surface/quads/quad_patch.h"

namespace carreau {

/// What pairs of triangles must be, beside strictly convex in (u, v).
struct PairRules {
  /// Of an edge between two local vertices: it is one of a curve.
  std::function<bool(std::int32_t, std::int32_t)> is_imposed;
  /// Of the corners of a triangle, in space.
  std::function<Vec3(std::int32_t)> position;
  double most_turn = 0.3;  ///< radians: largest angle between the normals of the two, in space
  double least_jacobian = 0;  ///< of the quadrilateral in space: only what exceeds it comes into question
};

/// Joins triangles of the patch, which has no other cells, by a matching of large weight. Quality is that in the metric
/// of `charts`; without charts, that in space.
void pair_triangles(QuadPatch& patch, const FaceCharts* charts, const PairRules& rules, Monitor& monitor);

}  // namespace carreau
