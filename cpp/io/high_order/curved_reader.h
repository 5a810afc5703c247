// SPDX-License-Identifier: BSD-3-Clause
// Reads files of elements of order 3 and 4.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "high_order/high_order_mesh.h"
#include "mesh/flat_mesh.h"

namespace carreau {

/// The mesh of a file: `curved` has elements of order 3 or 4 (null: none), `flat` the elements of order 1 or 2, or elements of order 2 whose
/// edges pass through the middles of curved ones.
struct MeshOfFile {
  FlatMesh flat;
  std::shared_ptr<const HighOrderMesh> curved = {};
};

/// Reads the formats of read_mesh() and MFEM's `.mesh` as write_curved() writes it. Throws its exceptions.
MeshOfFile read_mesh_of_any_order(const std::string& path);

/// Gmsh and VTK XML, as read_mesh_msh() and read_mesh_vtu(): elements of order 3 and 4 go to `curved`, by nodes of the file, which are then the
/// vertices of the mesh without elements. Mixed orders are errors.
FlatMesh read_mesh_msh(std::string_view content, const std::string& name, HighOrderMesh& curved);
FlatMesh read_mesh_vtu(std::string_view content, const std::string& name, HighOrderMesh& curved);
/// MFEM mesh v1.0: triangles and quadrilaterals of space with nodes of the collection L2_T1_2D_P2 to P4 (VDim 3, Ordering 1). Nodes of edges that
/// meet become one.
HighOrderMesh read_curved_mfem(std::string_view content, const std::string& name);

/// Appends an element to rows: the nodes in Gmsh's order. Returns false if elements of another order have come before.
bool add_curved(HighOrderMesh& mesh, int order, int corners, std::span<const std::int32_t> nodes, std::int32_t ref);

}  // namespace carreau
