// SPDX-License-Identifier: BSD-3-Clause
// Degrees of vertices, and swaps that bring them towards six.
#pragma once

#include <cstdint>
#include <vector>

#include "plane/kernel/plane_work.h"

namespace carreau::plane {

/// For each vertex, counted in triangles (at most 255). On the border a vertex of angle w should have w / 60 degrees
/// triangles.
struct Degrees {
  std::vector<std::uint8_t> found, wanted;

  [[nodiscard]] int excess(int v) const { return static_cast<int>(found[v]) - static_cast<int>(wanted[v]); }
};

[[nodiscard]] Degrees count_degrees(const PlaneWork& work);

/// Swaps that make the sum of the squared excesses less and leave decent triangles. Keeps `degrees`.
void swap_to_degree_six(PlaneWork& work, Degrees& degrees);

}  // namespace carreau::plane
