// SPDX-License-Identifier: BSD-3-Clause
// What makes elements other than straight triangles unusable. For find_defects().
#pragma once

#include <string>
#include <vector>

#include "mesh/flat_mesh.h"

namespace carreau {

/// One sentence a defect of a mesh whose straight triangles are sound: lists that do not fit, nodes on edges that faces
/// do not share or nothing holds, Jacobians that are not positive in (u, v) or in space (Bernstein coefficients).
std::vector<std::string> find_cell_defects(const SurfaceMesh& mesh);
/// The same of a mesh as files have it, of its elements alone.
std::vector<std::string> find_cell_defects(const FlatMesh& mesh);

}  // namespace carreau
