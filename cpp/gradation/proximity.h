// SPDX-License-Identifier: BSD-3-Clause
// Narrow zones: distances between boundaries, measured in space along the surface (HDR sec. 1.1.2).
#pragma once

#include <cstdint>
#include <vector>

#include "gradation/gradation.h"
#include "support/monitor.h"

namespace carreau {

/// A vertex of a narrow zone.
struct NarrowPlace {
  int vertex = 0;
  double gap = 0;  ///< distance of the two boundaries there
  Vec3 across;     ///< unit, from one to the other
};

/// Looks for places where two boundaries face each other: `sides[t]` has bit i set when the side of triangle t from
/// corner i to the next one lies on a boundary. Fronts leave the boundaries; where two meet head on, their ways add up
/// to the gap. Corners of less than 100 degrees do not make a zone narrow: sides that meet in such a corner have no
/// reported gap within two gaps of it. If the corner is sharp, they have none within `wanted`, one finite size a
/// vertex: a wedge ends in one triangle. A vertex may be reported several times.
std::vector<NarrowPlace> find_narrow_places(const GradationGraph& graph, const std::vector<std::uint8_t>& sides,
                                            const std::vector<double>& wanted, Monitor& monitor);

}  // namespace carreau
