// SPDX-License-Identifier: BSD-3-Clause
// Changes of the mesh around one bad triangle: each is kept only if it improves the triangles that it touches.
#pragma once

#include <cstdint>
#include <vector>

#include "plane/kernel/plane_work.h"
#include "plane/kernel/star.h"
#include "plane/optimise/memo.h"

namespace carreau::plane {

struct Mending {
  PlaneWork& work;
  std::vector<std::int32_t> changed = {};  ///< triangles to be tested again
  std::vector<std::int32_t> nudged = {};   ///< changed by so little that they need not be
  std::int64_t shapes_asked = 0;           ///< so far
  Memo<bool> failed_moves = {};            ///< of stars
  Memo<bool> failed_points = {};           ///< of new points and their cavities
  Star star = {};                          ///< scratch
};

/// An edge of t that is not imposed is much shorter than one.
[[nodiscard]] bool is_crowded(const PlaneWork& work, int t);

/// Removes an end of an edge of t that is much shorter than one: large changes of sizes over a triangle leave such
/// edges. No edge becomes too long by that, and no triangle bad.
bool remove_crowded_vertex(Mending& mending, int t);

/// Tries removals of crowded vertices, swaps, moves, removals and insertions, until t is bad no more.
bool mend(Mending& mending, int t);

}  // namespace carreau::plane
