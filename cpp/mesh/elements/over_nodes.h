// SPDX-License-Identifier: BSD-3-Clause
// Straight triangles over all nodes of elements of second order, for estimators and background meshes.
#pragma once

#include "mesh/flat_mesh.h"
#include "mesh/surface_mesh.h"

namespace carreau {

/// Replaces each triangle of six nodes by four triangles, and each quadrilateral of eight by six: the triangles at its corners and the
/// halves of the rest. Nodes on edges become vertices and keep their numbers; edges of curves are halves. A mesh of first order stays
/// as it is.
SurfaceMesh straight_over_nodes(const SurfaceMesh& mesh);
FlatMesh straight_over_nodes(FlatMesh mesh);

}  // namespace carreau
