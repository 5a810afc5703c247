// SPDX-License-Identifier: BSD-3-Clause
// Corners of elements at poles, which have any place of the side that a pole flattens.
#pragma once

#include <span>

#include "mesh/surface_mesh.h"
#include "surface/elements/base/curve_middles.h"
#include "surface/elements/base/poles.h"

namespace carreau::refining {

/// Gives elements local vertices of their own at a pole, if an element does not have its corner between its sides there. Middles of such
/// sides lie on their meridians, so that the part at the pole would not be convex in (u, v). `sides`: of curves.
void part_poles(FaceMesh& face, const Poles& poles, std::span<const CurveSide> sides);

}  // namespace carreau::refining
