// SPDX-License-Identifier: BSD-3-Clause
// The solids that a surface mesh bounds, for programs that fill them.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "mesh/flat_mesh.h"

namespace carreau {

/// A connected piece of space with an outer boundary.
struct MeshRegion {
  int solid = 0;  ///< number of its solid; 0: a hole, which no solid fills
  Vec3 inside;    ///< a point away from the boundary
  double longest_edge = 0;  ///< of the triangles around it
};

struct MeshRegions {
  /// The solid that each triangle looks out of, and the solid on the other side; 0: none.
  std::vector<std::array<int, 2>> sides;
  std::vector<MeshRegion> solids, holes;  ///< by solid, then in the order of their first triangles
  std::map<int, double> volumes;          ///< of solids, by the divergence theorem on the straight triangles
};

/// Finds regions by the sectors of space around each edge: sides of triangles that face each other bound one region. The
/// solids are EntityNames::face_solids; a mesh without them has a solid for each region that its triangles look out of.
/// A point inside lies between a triangle and the next one along its normal, and the winding number verifies it.
/// Throws InvalidArgument with the place when the surface is open, or when solids on both sides of an edge differ.
MeshRegions find_regions(const FlatMesh& mesh);

}  // namespace carreau
