// SPDX-License-Identifier: BSD-3-Clause
// Upper bounds of A0 and A1 of all triangles.
#pragma once

#include "measure/mesh_evaluation.h"

namespace carreau {

/// Fills deviation_bound, angle_bound and bound_share of `delivered`, whose edges, A0 and A1 are known: the bounds of triangle_bound.h, and
/// at least the samples of A0 and A1. The surface over a triangle of (u, v) is its image. The surface over a triangle whose corners are of
/// several charts is the part near its places, and A0 is then the distance of the triangle to the surface. NaN for elements other than
/// straight triangles, for triangles without area, and as angle_bound if no normal is known. Throws the exceptions of callbacks, and
/// Cancelled.
void bound_deviations(const SurfaceMesh& mesh, Cad& cad, const EvaluationOptions& options, Monitor& monitor,
                      MeshEvaluation& delivered);

}  // namespace carreau
