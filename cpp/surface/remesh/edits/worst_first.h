// SPDX-License-Identifier: BSD-3-Clause
// The worst triangles of a cross-patch mesh, at the end.
#pragma once

#include <cstdint>

#include "support/monitor.h"
#include "surface/remesh/base/cross_patch_mesh.h"

namespace carreau {

/// Shapes of all triangles, in the metric.
struct ShapeSummary {
  double mean = 1, worst = 1;  ///< Q2
  int count = 0;
};
/// The result is identical for any number of threads.
ShapeSummary summarise_shapes(const CrossPatchMesh& mesh, int threads, Monitor& monitor);

/// Swaps edges of triangles below `floor` and moves their corners, worst first. An edit must improve the worst triangle
/// around, bring no more lengths out of range, and agree with the surface. Returns the number of edits. Deterministic.
/// Throws the exceptions of the host, and Cancelled.
std::int64_t raise_worst(CrossPatchMesh& mesh, double floor, Monitor& monitor);

}  // namespace carreau
