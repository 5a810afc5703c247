// SPDX-License-Identifier: BSD-3-Clause
// Arrays of .vtu files about the places of nodes on the geometry.
#pragma once

#include <span>

#include "io/vtk/vtu_file.h"
#include "projection/mesh_association.h"

namespace carreau {

/// Adds, by node, the entity of lowest dimension, t on a curve, (u, v) on a face; NaN: the entity has another dimension.
void add_node_places(VtuFile& file, const MeshAssociation& association);

/// Adds, by cell, (u, v) of its nodes, as long as the largest cell requires: at seams and poles they depend on the cell. `counts`: nodes of each
/// element; elements are the first ones of `cells` cells.
void add_cell_places(VtuFile& file, std::span<const std::size_t> counts, std::size_t cells, const MeshAssociation& association);

}  // namespace carreau
