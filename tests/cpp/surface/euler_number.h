// SPDX-License-Identifier: BSD-3-Clause
// Euler's number of a mesh, whatever its elements.
#pragma once

#include <algorithm>
#include <array>
#include <set>

#include "mesh/cells.h"
#include "mesh/surface_mesh.h"

namespace carreau::testing {

/// Corners of elements - edges + elements.
inline int euler_number(const SurfaceMesh& mesh) {
  std::set<std::array<std::int32_t, 2>> edges;
  std::set<std::int32_t> corners;
  int cells = 0;
  for (const FaceMesh& face : mesh.faces)
    for (const Cell& cell : cells_of(mesh, face)) {
      ++cells;
      for (int i = 0, n = corner_count(cell.kind); i < n; ++i) {
        const std::int32_t a = cell.nodes[i], b = cell.nodes[(i + 1) % n];
        corners.insert(a);
        edges.insert({std::min(a, b), std::max(a, b)});
      }
    }
  return static_cast<int>(corners.size()) - static_cast<int>(edges.size()) + cells;
}

}  // namespace carreau::testing
