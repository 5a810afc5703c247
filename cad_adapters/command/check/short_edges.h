// SPDX-License-Identifier: BSD-3-Clause
// Edges below the lower bound of sizes: short curves and narrow zones of the input cause them whatever the bound is.
#pragma once

#include <carreau.h>

#include <cstdint>
#include <vector>

namespace command {

struct ShortEdges {
  double bound = 0;  ///< hphymin or hgeomin, the smaller of those in force; model length
  std::int64_t count = 0;
  double shortest = 0;              ///< of them, model length; 0: no such edge
  std::vector<std::int32_t> faces;  ///< that they belong to, ascending
};

/// Finds edges more than sqrt(2) times shorter than the bound: unit meshes have edges of 1 / sqrt(2) to sqrt(2).
/// `quality`: of the mesh.
ShortEdges find_short_edges(carreau_session* session, carreau_mesh* mesh, const carreau_quality& quality);

}  // namespace command
