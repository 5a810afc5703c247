// SPDX-License-Identifier: BSD-3-Clause
// Measures on polylines.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "model/topology.h"
#include "support/infinity.h"
#include "support/vec.h"

namespace carreau {

/// Throws InvalidArgument unless there is a trace of at least two points for each curve of the model.
void check_traces(const Model& model, const CurveTraces& traces);

double trace_length(std::span<const Vec3> trace);
/// Point at a fraction of the length, from the start.
Vec3 trace_point(std::span<const Vec3> trace, double fraction);
/// The nearest point of a trace.
struct TracePlace {
  double arc = 0;  ///< usual length from its start
  double distance = infinity;
  std::size_t segment = 0;  ///< from vertex `segment` to the next one
  double share = 0;         ///< of the segment, from its start
};
TracePlace nearest_on_trace(std::span<const Vec3> trace, const Vec3& p);
/// Largest distance of a vertex of `from` to the polyline `to` (HDR sec. 4.5.1); may stop early once it exceeds
/// `enough`. Distances up to `negligible` may be returned as `negligible`.
double one_sided_distance(std::span<const Vec3> from, std::span<const Vec3> to, double enough, double negligible = 0);
/// Both sides (HDR sec. 4.5.1).
double hausdorff_distance(std::span<const Vec3> p, std::span<const Vec3> q, double enough, double negligible = 0);
/// Diagonal of the box of all traces.
double traces_diagonal(const CurveTraces& traces);
/// Approximate deviation of the polyline from its curve: the largest distance of a vertex to the chord of its
/// neighbours. 0 for straight curves.
double trace_deviation(std::span<const Vec3> trace);
/// Largest distance of a vertex to the first one.
double trace_extent(std::span<const Vec3> trace);

}  // namespace carreau
