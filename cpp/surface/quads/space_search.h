// SPDX-License-Identifier: BSD-3-Clause
// Vertices of quadrilaterals that are poor in space, where charts have told them to be good.
#pragma once

#include "surface/quads/face_quads.h"

namespace carreau {

/// After lift(): vertices of quadrilaterals whose scaled Jacobian or quality in space is below
/// thresholds::quads::poor_in_space go where the least one around is largest, worst first, on the surface; cells stay convex in (u, v). Evaluations: about
/// thirty for each vertex that is tried. Where sizes differ by direction, only what is turned over is poor.
void improve_in_space(const ElementWork& work, const ControlSpace& metric, FaceQuads& quads, Monitor& monitor);

}  // namespace carreau
