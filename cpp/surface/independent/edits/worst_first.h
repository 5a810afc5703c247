// SPDX-License-Identifier: BSD-3-Clause
// The worst triangles of a free mesh, at the end.
#pragma once

#include <cstdint>

#include "support/monitor.h"
#include "surface/independent/base/free_mesh.h"

namespace carreau {

/// Of all triangles, in the metric.
struct ShapeSummary {
  double mean = 1, worst = 1;  ///< Q2
  int count = 0;
};
/// The same for any number of threads.
ShapeSummary summarise_shapes(const FreeMesh& mesh, int threads, Monitor& monitor);

/// Swaps edges of triangles below `floor` and moves their corners, worst first, where the worst one around is better
/// for it, no more lengths are out of range and the surface agrees. Number of edits. Deterministic. Throws what the
/// host throws, and Cancelled.
std::int64_t raise_worst(FreeMesh& mesh, double floor, Monitor& monitor);

}  // namespace carreau
