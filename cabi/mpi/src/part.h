// SPDX-License-Identifier: BSD-3-Clause
// The part of a mesh that is one rank's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "carreau_mpi.h"

/// Rows in the order of carreau_mpi.h: own ones first.
struct carreau_part {
  std::int64_t own_triangles = 0, own_vertices = 0;
  std::vector<std::int64_t> triangle;  ///< numbers in the mesh
  std::vector<std::int32_t> triangle_owner, triangle_layer;
  std::vector<std::array<std::int32_t, 3>> corners;  ///< numbers in the part
  std::vector<std::int64_t> vertex;                  ///< numbers in the mesh
  std::vector<std::int32_t> vertex_owner;
  std::vector<std::int64_t> row;
  /// The mesh of a part of carreau_mesh_generate_parts, which holds all of this; the lists are then empty. Else null.
  std::unique_ptr<carreau_mesh, void (*)(carreau_mesh*)> mesh{nullptr, carreau_mesh_free};
};

namespace carreau_mpi {

/// Throws Failure with the sentence of the mesh.
void require(carreau_mesh* mesh, carreau_status status);

/// A part with its lists: the lists of `part`, or lists made from its mesh. Rows of `xyz` are of its vertices, `refs` of its
/// triangles. `elements`: of other kinds than straight triangles, if the mesh has some.
struct ListedPart {
  struct Element {
    std::int32_t kind;
    std::vector<std::int32_t> nodes;
    std::size_t triangle;  ///< its first one
  };
  carreau_part part;
  std::vector<double> xyz;
  std::vector<std::int32_t> refs;
  std::vector<Element> elements = {};
};
ListedPart listed(const carreau_part& part);

/// The mesh that parts are made of.
struct WholeMesh {
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;
};

/// Throws Failure with the sentence of the mesh.
WholeMesh whole_mesh(carreau_mesh* mesh);

/// The rank of each triangle: parts of floor or ceil of m / size triangles.
std::vector<std::int32_t> bisect(const WholeMesh& mesh, int size);

/// `layers` >= 0.
carreau_part part_of(const WholeMesh& mesh, int rank, int size, int layers);

}  // namespace carreau_mpi
