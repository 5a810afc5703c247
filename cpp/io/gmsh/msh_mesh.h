// SPDX-License-Identifier: BSD-3-Clause
// Elements of any order as Gmsh's format lists them.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "mesh/flat_mesh.h"
#include "projection/mesh_association.h"

namespace carreau {

/// An edge of a curve (dimension 1) or an element of a face (2). Nodes are in the order of the format.
struct MshElement {
  int dim = 2, type = 2, corners = 3;
  std::int32_t ref = 0;
  std::span<const std::int32_t> nodes;
};

/// The content of a file. Its source must live as long.
struct MshMesh {
  MshMesh() = default;
  /// Without `curve_groups`: no elements of curves and no points.
  MshMesh(const FlatMesh& mesh, bool curve_groups);
  MshMesh(const MshMesh&) = delete;
  MshMesh& operator=(const MshMesh&) = delete;

  int dimension = 3;  ///< 2: z is 0
  std::span<const Vec3> nodes;
  std::vector<MshElement> elements;
  const std::vector<std::int32_t>* node_refs = nullptr;  ///< positive at points; nullptr: no points
  const EntityNames* names = nullptr;
  const std::vector<FlatFace>* faces = nullptr;  ///< their names
  const std::vector<PeriodicLink>* periodic = nullptr;
  std::vector<std::int32_t> own_nodes = {};  ///< of elements whose nodes the source has in no row
};

/// Version 4.1 or 2.2. `association`: parameters of nodes; nullptr: none.
std::string msh_text(const MshMesh& mesh, bool version_2, const MeshAssociation* association);

}  // namespace carreau
