// SPDX-License-Identifier: BSD-3-Clause
// Defects of elements other than straight triangles. For find_defects().
#pragma once

#include <string>
#include <vector>

#include "mesh/flat_mesh.h"

namespace carreau {

/// Returns one sentence a defect of a mesh whose straight triangles are sound. Checks sizes of lists, nodes on edges
/// that faces do not share or no element uses, and Jacobians that are not positive in (u, v) or in space (Bernstein
/// coefficients).
std::vector<std::string> find_cell_defects(const SurfaceMesh& mesh);
/// Checks the elements of a mesh of a file.
std::vector<std::string> find_cell_defects(const FlatMesh& mesh);

}  // namespace carreau
