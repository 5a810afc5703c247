// SPDX-License-Identifier: BSD-3-Clause
// Finds the places where triangles of a mesh cross, and the new ones among them.
#pragma once

#include <cstdint>
#include <vector>

#include "support/monitor.h"
#include "support/vec.h"
#include "surface/result.h"

namespace carreau {

struct CrossingPlace {
  Vec3 place;
  double size = 0;                  ///< prescribed there
  std::vector<std::int32_t> faces;  ///< of the corners of both triangles, ascending, each once
};

/// Crossings of straight halves of elements, in a mesh that is free of patches; the first thousand.
std::vector<CrossingPlace> find_crossing_places(const SizedMesh& mesh, int threads, Monitor& monitor);

/// Returns the places of `now` that are farther than their size from all of `before`. Surfaces that cross do so whatever the mesh, by other
/// triangles.
std::vector<CrossingPlace> new_places(const std::vector<CrossingPlace>& before, const std::vector<CrossingPlace>& now);

}  // namespace carreau
