// SPDX-License-Identifier: BSD-3-Clause
// Upper bounds of A0 and A1 of all triangles.
#pragma once

#include "measure/mesh_evaluation.h"

namespace carreau {

/// Fills deviation_bound, angle_bound and bound_share of `delivered`, of which the edges, A0 and A1 are known: what triangle_bound.h says, and no less
/// than the samples of A0 and A1. The surface over a triangle of (u, v) is its image; over one whose corners are of several charts it is what is near
/// its places, and A0 is then the distance of the triangle to the surface. NaN for elements other than straight triangles, for triangles without area,
/// and as angle_bound where no normal is known. Throws what callbacks throw, and Cancelled.
void bound_deviations(const SurfaceMesh& mesh, Cad& cad, const EvaluationOptions& options, Monitor& monitor,
                      MeshEvaluation& delivered);

}  // namespace carreau
