// SPDX-License-Identifier: BSD-3-Clause
// Values beyond a limit that no other mesh would keep.
#pragma once

#include "measure/mesh_evaluation.h"

namespace carreau {

/// Fills Delivery::forced after values beyond the limits are counted. Forced angles belong to edges no longer than
/// `shortest` (model length) and to triangles with such edges alone; forced gradations belong to inner edges that
/// curves hold at both ends.
void count_forced(const SurfaceMesh& mesh, double shortest, MeshEvaluation& delivered);

}  // namespace carreau
