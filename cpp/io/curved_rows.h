// SPDX-License-Identifier: BSD-3-Clause
// Elements of order 3 and 4 as readers of formats gather them, and the orders of their nodes.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "high_order/high_order_mesh.h"
#include "mesh/flat_mesh.h"

namespace carreau {

/// Appends an element to rows: the nodes in Gmsh's order. Returns false if elements of another order have come before.
bool add_curved(HighOrderMesh& mesh, int order, int corners, std::span<const std::int32_t> nodes, std::int32_t ref);

/// Gmsh and VTK XML, as read_mesh_msh() and read_mesh_vtu(): elements of order 3 and 4 go to `curved`, by nodes of the file, which are then the
/// vertices of the mesh without elements. Mixed orders are errors.
FlatMesh read_mesh_msh(std::string_view content, const std::string& name, HighOrderMesh& curved);
FlatMesh read_mesh_vtu(std::string_view content, const std::string& name, HighOrderMesh& curved);

/// For each node in another order its rank in Gmsh's. VTK orders nodes of quadrilaterals along s and t: the third and fourth edge run backwards,
/// and inner nodes are rows. MFEM orders nodes of discontinuous elements by rows of t.
std::vector<std::size_t> vtk_ranks_of_quad(int order);
std::vector<std::size_t> mfem_ranks(bool quad, int order);

}  // namespace carreau
