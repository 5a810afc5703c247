// SPDX-License-Identifier: BSD-3-Clause
// Pairs of vertices of degrees five and seven, at the ends of layers of the advancing front. In graded sizes some pairs
// are necessary; many of the others find a partner a few edges away that cancels them.
#pragma once

#include "plane/kernel/plane_work.h"
#include "plane/optimise/degrees.h"

namespace carreau::plane {

/// Moves pairs along their layers, at most `reach` steps, if a second pair cancels them; otherwise all stay.
void cancel_degree_pairs(PlaneWork& work, Degrees& degrees, int reach);

/// In dense places, merges vertices with few neighbours into one of them if degrees move no farther from six: a layer
/// ends one point earlier.
void remove_surplus_vertices(PlaneWork& work, Degrees& degrees);

}  // namespace carreau::plane
