// SPDX-License-Identifier: BSD-3-Clause
// Values beyond a limit that no other mesh would keep.
#pragma once

#include "measure/mesh_evaluation.h"

namespace carreau {

/// Fills Delivery::forced once values beyond the limits are counted: angles of edges no longer than `shortest` (model
/// length) and of triangles with such edges alone; gradations of edges inside faces that curves hold at both ends.
void count_forced(const SurfaceMesh& mesh, double shortest, MeshEvaluation& delivered);

}  // namespace carreau
