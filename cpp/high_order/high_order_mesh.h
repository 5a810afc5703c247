// SPDX-License-Identifier: BSD-3-Clause
// Elements of order 3 and 4 over the elements of a mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "high_order/shape.h"
#include "mesh/periodic_link.h"
#include "model/names.h"
#include "projection/mesh_association.h"

namespace carreau {

/// Elements of one order. Nodes: the vertices of the mesh with equal numbers, then nodes on edges, then inner nodes. Rows are in Gmsh's order.
struct HighOrderMesh {
  int order = 3;
  NodePlaces places = NodePlaces::equidistant;
  std::vector<Vec3> nodes;
  std::int32_t corners = 0;  ///< vertices of the mesh
  std::vector<std::int32_t> triangles, triangle_refs;  ///< rows of (p + 1)(p + 2) / 2 nodes
  std::vector<std::int32_t> quads, quad_refs;          ///< rows of (p + 1)^2 nodes
  std::vector<std::int32_t> edges, edge_refs;          ///< rows of p + 1 nodes: both ends, then the others
  std::vector<std::int32_t> corner_refs;               ///< by vertex; positive: of points
  EntityNames names = {};                              ///< of curves and points
  std::vector<std::pair<std::int32_t, std::string>> face_names = {};
  std::int64_t repaired = 0;              ///< elements that were invalid at first, and are valid
  std::vector<std::int32_t> invalid;      ///< elements that stay invalid: triangles, then quadrilaterals behind them
  std::vector<std::array<std::int32_t, 2>> coarse = {};  ///< their edges off curves, by vertices; all edges of elements between curves
  std::vector<PeriodicLink> periodic = {};  ///< with all nodes
  MeshAssociation association = {};  ///< of the nodes; cell_uv of triangles, then of quadrilaterals. Empty: not known
};

/// The mesh with nodes of its elements at equidistant or other places: the polynomials stay. Nodes that move lose their association.
HighOrderMesh with_places(const HighOrderMesh& mesh, NodePlaces places);

}  // namespace carreau
