// SPDX-License-Identifier: BSD-3-Clause
// Improves vertices of quadrilaterals that are poor in space, although charts measure them as good.
#pragma once

#include "surface/elements/quads/face_quads.h"

namespace carreau {

/// After lift(): moves vertices of quadrilaterals whose scaled Jacobian or quality in space is below thresholds::quads::poor_in_space,
/// worst first, on the surface. A vertex goes where the least value around is largest; cells stay convex in (u, v). Evaluations: about
/// thirty for each vertex that is moved or examined. If sizes differ by direction, only cells that are turned over are poor.
void improve_in_space(const ElementWork& work, const ControlSpace& metric, FaceQuads& quads, Monitor& monitor);

}  // namespace carreau
