// SPDX-License-Identifier: BSD-3-Clause
// Faces of assembled meshes as images of other faces: triangle k is the image of triangle k.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/surface_mesh.h"
#include "periodic/match_faces.h"
#include "support/monitor.h"

namespace carreau {

/// Local vertices of the slave by local vertices of the master; -1: no triangle has it.
std::vector<std::int32_t> local_images(const FaceMesh& from, const FaceMesh& to, bool flipped);

/// Gives the slave the elements of its master: `vertex` maps local vertices as above.
void carry_elements(const FaceMesh& from, const std::vector<std::int32_t>& vertex, bool flipped, FaceMesh& to);
/// Gives the sides of its triangles the nodes of its master's, with their numbers (FaceMesh::mid).
void carry_mids(const FaceMesh& from, bool flipped, FaceMesh& to);

/// Moves vertices and nodes inside the slave to the images of the master's. `fixed`: local vertices, and nodes on edges, that
/// stay where they are. `exact`: see place_images().
void follow_master(Cad& cad, const FacePair& pair, const std::vector<char>& fixed, const std::vector<char>& fixed_mids, double exact,
                   SurfaceMesh& mesh);

}  // namespace carreau
