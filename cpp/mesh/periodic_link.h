// SPDX-License-Identifier: BSD-3-Clause
// Parts of a mesh that a map carries onto each other.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "model/isometry.h"

namespace carreau {

/// A face, curve or corner and its image.
struct PeriodicLink {
  int dimension = 2;             ///< 2: faces, 1: curves, 0: corners
  int master = 0, slave = 0;     ///< references
  Isometry map;                  ///< of the master onto the slave
  /// {slave, master}, ascending. In a SurfaceMesh nodes on edges number its vertices plus their index in mid_vertices.
  std::vector<std::array<std::int32_t, 2>> nodes = {};
};

}  // namespace carreau
