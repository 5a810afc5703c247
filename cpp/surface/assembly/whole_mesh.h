// SPDX-License-Identifier: BSD-3-Clause
// Figures and clean-up of assembled meshes, of any kind.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/result.h"

namespace carreau {

/// Vertices - edges + triangles.
std::int64_t euler_number(const SurfaceMesh& mesh);

/// New numbers of vertices, and of nodes on edges; -1: dropped.
struct NewNumbers {
  std::vector<std::int32_t> vertex, mid;
};

/// Drops vertices and nodes that no face and no curve has. The others keep their order. Links of periodic faces stay as they are.
NewNumbers drop_unused(SizedMesh& made);

}  // namespace carreau
