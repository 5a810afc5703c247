// Measures on polylines.
#pragma once

#include <span>
#include <vector>

#include "support/vec.h"

namespace carreau {

double trace_length(std::span<const Vec3> trace);
/// Point at a fraction of the length, from the start.
Vec3 trace_point(std::span<const Vec3> trace, double fraction);
/// Largest distance of a vertex of `from` to the polyline `to` (HDR eq. 2.25); may stop early once it exceeds `enough`.
double one_sided_distance(std::span<const Vec3> from, std::span<const Vec3> to, double enough);
/// Both sides (HDR sec. 4.5.1).
double hausdorff_distance(std::span<const Vec3> p, std::span<const Vec3> q, double enough);
/// Largest distance of a vertex to the first one.
double trace_extent(std::span<const Vec3> trace);

}  // namespace carreau
