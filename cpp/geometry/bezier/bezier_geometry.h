// SPDX-License-Identifier: BSD-3-Clause
// Bezier patches as a geometry that the engine evaluates itself.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/bezier/bezier_patch.h"
#include "geometry/built_geometry.h"

namespace carreau {

/// Curves of a patch: v = 0, u = 1, v = 1, u = 0, as they run counterclockwise around the unit square.
inline constexpr int bezier_sides = 4;

struct BezierPatches {
  std::vector<BezierPatch> patches;
  /// References of the sides of each patch; empty: gluing finds them in space.
  std::vector<std::array<int, bezier_sides>> side_refs;
};

/// Face k, from 1, is patch k, on the left of its sides. If side_refs marks several sides as one curve, the corners at
/// its ends become one, each the nearest corner of the other side. They get references from 1 in the order of faces;
/// else references are 0. Throws InvalidArgument for no patch, a degree that is not from 1 to largest_bezier_degree, or
/// a wrong number of points. Also for a point that is not finite or above 1e100, and for a reference that is not
/// positive.
BuiltGeometry build_bezier(BezierPatches patches);

}  // namespace carreau
