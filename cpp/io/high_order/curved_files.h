// SPDX-License-Identifier: BSD-3-Clause
// Files of elements of order 3 and 4.
#pragma once

#include <string>

#include "high_order/high_order_mesh.h"

namespace carreau {

/// Gmsh 4.1 or 2.2, ASCII (`.msh`, `.msh2`; element types 8, 9, 10, 21, 23, 26, 27, 36, 37), VTK XML (`.vtu`, Lagrange cells 68, 69, 70) and MFEM (`.mesh`, v1.0 with
/// a section of nodes, collection L2_T1_2D_Pp). The first two have equidistant nodes, the last one Gauss-Lobatto's: nodes at other places are
/// evaluated on the elements. `association`: the places of nodes on the geometry are written, too; `.mesh` cannot hold them. Throws
/// InvalidArgument for another suffix, for a reference below 1 in `.mesh`, and for an association of nodes that are not equidistant; FileError.
void write_curved(const HighOrderMesh& mesh, const std::string& path, bool association = false);

std::string curved_msh(const HighOrderMesh& mesh, bool association = false, bool version_2 = false);
std::string curved_vtu(const HighOrderMesh& mesh, bool association = false);
std::string curved_mfem(const HighOrderMesh& mesh);

}  // namespace carreau
