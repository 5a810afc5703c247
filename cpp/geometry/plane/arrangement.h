// SPDX-License-Identifier: BSD-3-Clause
// The arrangement of segments of a plane domain: segments meet only at points.
#pragma once

#include <cstddef>

#include "geometry/plane/plane_domain.h"

namespace carreau {

struct SegmentArrangement {
  std::size_t merged_points = 0;      ///< had the place of an earlier point
  std::size_t crossings = 0;          ///< new points where two segments cross
  std::size_t points_on_segments = 0; ///< points that divide a segment
  std::size_t dropped_segments = 0;   ///< of no length, or between the points of an earlier one
};

/// Merges points of equal coordinates, and divides segments where others cross them or points lie on them, as Triangle
/// does (J. R. Shewchuk, "Triangle", 1996, sec. 3). Exact predicates decide whether segments meet; crossings are
/// rounded, and crossings within rounding of a point are this point. Pieces have the references of their segment. Every
/// curve of the domain must be one segment. Throws InvalidModel when rounding leaves crossings after several rounds.
SegmentArrangement arrange_segments(PlaneDomainInput& input);

}  // namespace carreau
