// SPDX-License-Identifier: BSD-3-Clause
// What a mesh of patches and of triangles delivered.
#pragma once

#include <functional>

#include "measure/mesh_evaluation.h"

namespace carreau {

/// `mesh` is that of beside_each_other(), whose vertices are those of the patches and, behind them, those of the
/// triangles; `of_triangles` tells by face which it is of. Limits that one part has count for it alone.
MeshEvaluation beside_each_other(const SurfaceMesh& mesh, const MeshEvaluation& patches, const MeshEvaluation& triangles,
                                 const std::function<bool(std::size_t face)>& of_triangles);

}  // namespace carreau
