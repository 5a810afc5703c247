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

/// MFEM mesh v1.0: triangles and quadrilaterals of space with nodes of the collection L2_T1_2D_P2 to P4 (VDim 3, Ordering 1). Nodes of edges that
/// meet become one.
HighOrderMesh read_curved_mfem(std::string_view content, const std::string& name);

}  // namespace carreau
