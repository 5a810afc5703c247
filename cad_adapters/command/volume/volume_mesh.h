// SPDX-License-Identifier: BSD-3-Clause
// Tetrahedra inside a surface.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "volume/solid_surface.h"

namespace command {

struct VolumeMesh {
  SolidSurface surface;  ///< its vertices are the first ones
  std::vector<Point> vertices;  ///< corners, then nodes on edges
  std::vector<std::array<std::int32_t, 4>> tetrahedra;  ///< positive orientation: the fourth corner is before the triangle of the others
  std::vector<std::int32_t> solids;                     ///< of tetrahedra
  /// Order 2: nodes of the edges 01, 12, 20, 03, 13, 23 of each tetrahedron, and of 01, 12, 20 of each triangle; else empty.
  std::vector<std::array<std::int32_t, 6>> tetrahedron_mids;
  std::vector<std::array<std::int32_t, 3>> triangle_mids;
  std::size_t corners = 0;     ///< vertices without nodes on edges
  std::size_t straightened = 0;  ///< edges of the surface whose nodes moved to their middles
  bool has_coarse_sizes = false;  ///< the sizes that the engine got vary less than the size map
  std::string engine;
  double seconds = 0;          ///< of the engine
  double smallest_shape = 0;   ///< least radius ratio: 3 inradius / circumradius, 1 for a regular tetrahedron

  [[nodiscard]] bool is_quadratic() const noexcept { return !tetrahedron_mids.empty(); }
};

}  // namespace command
