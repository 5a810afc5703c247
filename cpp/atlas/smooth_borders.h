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

/// Describes parts by their outer border in place of the inner one, and turns `pieces` into the inner border. At joints the outer border gets
/// short edges parallel to the inner one, so that both are C1 there (Atlas sec. 5.3.2.3 and eq. 5.11). Returns the outer border.
Polygon begin_outside(std::vector<Part>& parts, std::vector<OuterPieces>& pieces);

/// Reduces the widths that the ratios of parts give: equal at joints, with changes by radian of at most `steepest`.
void limit_slopes(std::vector<Part>& parts, double steepest);

/// Rounds vertices of the border that parts describe and constructs the other one, so that both stay between `pieces` and the polygon
/// inside.
void smooth_borders(std::vector<Part>& parts, std::vector<OuterPieces> pieces, OuterBorder kind);

}  // namespace carreau::atlas
