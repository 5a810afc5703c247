// SPDX-License-Identifier: BSD-3-Clause
// Smooth borders inside a polygonal annulus (Atlas sec. 5.4.2, 5.4.3).
#pragma once

#include <span>
#include <vector>

#include "atlas/outer_border.h"

namespace carreau::atlas {

/// Function over the outer border, as a multiple of the inner one.
enum class OuterBorder {
  polygon,  ///< the straight pieces themselves; the annulus is C0 only
  spline,   ///< a cubic between two knots
  cubic     ///< one cubic a pivot: simpler, covers less
};

/// Rounds vertices of the inner border and constructs the outer one, so that both stay between `pieces` and the polygon
/// inside.
void smooth_borders(std::vector<Part>& parts, std::vector<OuterPieces> pieces, OuterBorder kind);

}  // namespace carreau::atlas
