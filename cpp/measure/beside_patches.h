// SPDX-License-Identifier: BSD-3-Clause
// Measures of a mesh of patches and of triangles.
#pragma once

#include <functional>

#include "measure/mesh_evaluation.h"

namespace carreau {

/// `mesh` is the mesh of beside_each_other(): the vertices of the patches and, behind them, the vertices of the
/// triangles; `of_triangles` returns true for faces of the triangles. Limits that one part has count for it alone.
MeshEvaluation beside_each_other(const SurfaceMesh& mesh, const MeshEvaluation& patches, const MeshEvaluation& triangles,
                                 const std::function<bool(std::size_t face)>& of_triangles);

}  // namespace carreau
