// SPDX-License-Identifier: BSD-3-Clause
// Bad triangles that no single change repairs. The search makes each change around them with the moves and swaps that
// it needs, worst triangles first, and keeps the best one.
#pragma once

#include "control_space/sampled_normals.h"
#include "plane/kernel/plane_work.h"
#include "plane/kernel/settled.h"

namespace carreau::plane {

/// Requires a field that does not bend. On curved surfaces, whose `normals` are given, no change adds an edge between
/// two fixed vertices. No change adds edges along which the surface turns more than along the previous edges: flat
/// spots. `settled`: the result of optimise().
void search_around_bad_triangles(PlaneWork& work, const Settled& settled, const SampledNormals* normals);

}  // namespace carreau::plane
