// SPDX-License-Identifier: BSD-3-Clause
// A mesh as heights over pieces of planes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "support/vec.h"

namespace carreau {

/// The triangles of a mesh with their neighbours. Keeps views of the arrays that it is given. Safe from several threads.
class HeightSearch {
 public:
  HeightSearch(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles);

  /// The largest height of the mesh over a convex polygon with this unit normal: no point of the polygon is farther from
  /// the mesh. Triangles are followed from `start` over all edges that lie over the polygon. They cover the polygon if no
  /// border of the mesh lies over it and all triangles have equal orientation, since the degree of the projection is
  /// constant then. Empty if they do not, or if a height exceeds `enough`.
  [[nodiscard]] std::optional<double> largest_over(std::span<const Vec3> polygon, const Vec3& normal, std::int32_t start,
                                                   double enough) const;

 private:
  std::span<const Vec3> vertices_;
  std::span<const std::array<std::int32_t, 3>> triangles_;
  std::vector<std::array<std::int32_t, 3>> beyond_;  // the triangle beyond side i, from corner i to i + 1; -1: none, or more than one
};

}  // namespace carreau
