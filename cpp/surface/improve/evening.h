// SPDX-License-Identifier: BSD-3-Clause
// How changes of neighbouring edges are judged. Private to even_edges.
#pragma once

#include <algorithm>
#include <cmath>

#include "surface/improve/thresholds.h"

#include "metric/unit_edge.h"
#include "support/rounding_of.h"

namespace carreau {

/// Lengths of edges in the metric that fit.
struct LengthRange {
  double shortest = unit_edge::shortest, longest = unit_edge::longest;

  [[nodiscard]] bool excludes(double length) const noexcept { return length < shortest || length > longest; }
};

/// A judgement of some edges and triangles.
struct EveningJudgement {
  double excess = 0;   ///< sum over the limit, as a share of the limit
  int out = 0;         ///< edges that are too long or too short
  double quality = 1;  ///< of the worst triangle
  double beyond = 0;   ///< largest angle or offset of a triangle, as a share of the bound

  [[nodiscard]] bool better_than(const EveningJudgement& other) const noexcept {
    if (std::abs(excess - other.excess) > rounding_of::places) return excess < other.excess;
    return out != other.out ? out < other.out : quality > other.quality;
  }
  /// Ignores the excess. Triangles of quality `good` are never worse.
  [[nodiscard]] bool no_worse_than(const EveningJudgement& before, double good) const noexcept {
    return out <= before.out && quality >= std::min(before.quality, good) && beyond <= std::max(before.beyond, 1.);
  }
  [[nodiscard]] bool improves(const EveningJudgement& before, double good) const noexcept {
    // A gain in the sum of the excesses, so that changes come to an end.
    return excess < before.excess - 1e-4 && no_worse_than(before, good);
  }
};

}  // namespace carreau
