// SPDX-License-Identifier: BSD-3-Clause
// Pairs of vertices of degrees five and seven, where a layer of the advancing front ends. Where sizes grow some must
// be; of the others many find a partner a few edges away that they cancel with.
#pragma once

#include "plane/kernel/plane_work.h"
#include "plane/optimise/degrees.h"

namespace carreau::plane {

/// Moves pairs along their layers, at most `reach` steps, as far as they cancel with another one; else all stays.
void cancel_degree_pairs(PlaneWork& work, Degrees& degrees, int reach);

/// Where points are dense, draws vertices with few neighbours into one of them when degrees get no farther from six: a
/// layer ends one point earlier.
void remove_surplus_vertices(PlaneWork& work, Degrees& degrees);

}  // namespace carreau::plane
