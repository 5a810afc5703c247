// SPDX-License-Identifier: BSD-3-Clause
// The judgement of all edits in space: the triangles that an edit replaces, and the triangles that it makes.
#pragma once

#include <algorithm>

#include "mesh/quality.h"
#include "support/infinity.h"

namespace carreau {

/// Sums of the shapes of some triangles.
struct TriangleShapes {
  double worst = 1;      ///< Q2, in the metric if sizes differ by direction
  double inverses = 0;   ///< sum of 1 / Q2
  double sum = 0;        ///< of Q2
  int count = 0;
  double share = 0;      ///< the largest A0 or A1 over its tolerance, by the normals at the corners; across patches its square

  void add(double quality) noexcept {
    worst = std::min(worst, quality);
    inverses += 1 / std::max(quality, flat_quality);
    sum += quality;
    ++count;
  }
};

struct Change {
  TriangleShapes before, after;

  /// No triangle is worse than `least` unless a triangle before was as bad.
  [[nodiscard]] bool keeps_shapes(double least) const noexcept { return after.worst >= std::min(before.worst, least); }
  /// No triangle exceeds the tolerances of A0 and A1 unless a triangle before did as much. `most`: largest share.
  [[nodiscard]] bool keeps_surface(double most = 1) const noexcept {
    return after.share < infinity && after.share <= std::max(most, before.share);
  }
};

}  // namespace carreau
