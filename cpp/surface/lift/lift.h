// SPDX-License-Identifier: BSD-3-Clause
// From a plane mesh to the surface.
#pragma once

#include "surface/patch.h"

namespace carreau {

/// Position of every vertex in space: surf0 once for each that lies on no curve.
void lift_patch(const PatchInput& input, Cad& cad, PatchMesh& mesh, Monitor& monitor);

}  // namespace carreau
