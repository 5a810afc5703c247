// SPDX-License-Identifier: BSD-3-Clause
// Bad triangles that no single change mends: each change around them is tried with the moves and swaps that make room
// for it, worst triangles first, and the best one is kept.
#pragma once

#include "control_space/sampled_normals.h"
#include "plane/kernel/plane_work.h"
#include "plane/kernel/settled.h"

namespace carreau::plane {

/// Not where fields bend. On surfaces that are no planes, whose `normals` are given, no change adds an edge between two
/// fixed vertices, nor edges along which the surface turns more than along those that were there: flat spots. `settled`:
/// what optimise() has left.
void search_around_bad_triangles(PlaneWork& work, const Settled& settled, const SampledNormals* normals);

}  // namespace carreau::plane
