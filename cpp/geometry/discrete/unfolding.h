// SPDX-License-Identifier: BSD-3-Clause
// Tangents around vertices that turn back (HDR eq. 4.101 to 4.103).
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/discrete/normals.h"

namespace carreau::discrete {

struct Unfolding {
  std::int64_t unfolded = 0;  ///< tangents that turned back, of regular edges
  std::int64_t folded = 0;    ///< that still do: between two sharp edges nothing can be turned
};

/// Turns tangents of regular edges at their ends until the tangents around each vertex follow each other.
Unfolding unfold(const Triangulation& mesh, const SharpLines& lines, const Frames& frames, std::vector<Cubic>& curves);

}  // namespace carreau::discrete
