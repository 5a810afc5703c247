// SPDX-License-Identifier: BSD-3-Clause
// Numbers of the vertices that triangles have, without nodes on edges.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/flat_mesh.h"

namespace carreau {

/// Keeps the order of vertices.
struct CornerNumbers {
  std::vector<std::size_t> vertices;  ///< index in FlatMesh::vertices, ascending
  std::vector<std::size_t> number;    ///< of each vertex of the mesh, from 1; 0: no triangle has it

  explicit CornerNumbers(const FlatMesh& mesh) : number(mesh.vertices.size(), 0) {
    for (const auto& triangle : mesh.triangles)
      for (const std::int32_t v : triangle) number[static_cast<std::size_t>(v)] = 1;
    for (std::size_t v = 0; v < number.size(); ++v)
      if (number[v] != 0) vertices.push_back(v), number[v] = vertices.size();
  }
};

}  // namespace carreau
