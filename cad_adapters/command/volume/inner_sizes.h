// SPDX-License-Identifier: BSD-3-Clause
// Edge lengths inside solids: a mesh of the box around the surface, with a size at each node.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "volume/solid_surface.h"

namespace command {

/// Bounds of edge lengths inside solids.
struct InnerBounds {
  double largest = 0;  ///< everywhere; 0: none
  double growth = 0;   ///< slope at which sizes grow from the surface: 0.3 for edges that grow by 1.3
  std::function<double(const Point&)> map;  ///< a size at a place, from options; may be empty. A value that is no size is no bound
};

/// Conforming tetrahedra around the surface, whose linear interpolation is the size.
struct InnerSizes {
  std::vector<Point> nodes;
  std::vector<double> sizes;  ///< of nodes
  std::vector<std::array<std::int32_t, 4>> tetrahedra;  ///< positive orientation, as in VolumeMesh
  bool is_coarse = false;     ///< the map varies more than the largest number of cells resolves
};

/// Sizes that start at the surface's own, grow away from it, and satisfy all bounds.
InnerSizes inner_sizes_of(const SolidSurface& surface, const InnerBounds& bounds);

}  // namespace command
