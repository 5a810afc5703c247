// SPDX-License-Identifier: BSD-3-Clause
// Files of elements of order 3 and 4.
#pragma once

#include <string>

#include "high_order/high_order_mesh.h"

namespace carreau {

/// Gmsh 4.1 ASCII (`.msh`, element types 8, 9, 10, 21, 23, 26, 27, 36, 37), VTK XML (`.vtu`, Lagrange cells 68, 69, 70) and MFEM (`.mesh`, v1.0 with
/// a section of nodes, collection L2_T1_2D_Pp). The first two have equidistant nodes, the last one Gauss-Lobatto's: nodes at other places are
/// evaluated on the elements. Throws InvalidArgument for another suffix, and for a reference below 1 in `.mesh`; FileError.
void write_curved(const HighOrderMesh& mesh, const std::string& path);

std::string curved_msh(const HighOrderMesh& mesh);
std::string curved_vtu(const HighOrderMesh& mesh);
std::string curved_mfem(const HighOrderMesh& mesh);

}  // namespace carreau
