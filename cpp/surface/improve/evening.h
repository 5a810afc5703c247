// SPDX-License-Identifier: BSD-3-Clause
// How changes of neighbouring edges are judged. Private to even_edges.
#pragma once

#include <cmath>

#include "mesh/trial.h"
#include "metric/unit_edge.h"
#include "support/rounding_of.h"
#include "surface/improve/thresholds.h"

namespace carreau {

/// Lengths of edges in the metric that fit.
struct LengthRange {
  double shortest = unit_edge::shortest, longest = unit_edge::longest;

  [[nodiscard]] bool excludes(double length) const noexcept { return length < shortest || length > longest; }
};

/// A judgement of some edges and triangles.
struct EveningJudgement : TriangleShapes {
  double excess = 0;  ///< sum over the limit, as a share of the limit
  int out = 0;        ///< edges that are too long or too short

  [[nodiscard]] bool better_than(const EveningJudgement& other) const noexcept {
    if (std::abs(excess - other.excess) > rounding_of::places) return excess < other.excess;
    return out != other.out ? out < other.out : worst > other.worst;
  }
  /// Ignores the excess. Triangles of quality `good` are never worse.
  [[nodiscard]] bool no_worse_than(const EveningJudgement& before, double good) const noexcept {
    const Change change{before, *this};
    return out <= before.out && change.keeps_shapes(good) && change.keeps_surface();
  }
  [[nodiscard]] bool improves(const EveningJudgement& before, double good) const noexcept {
    // A gain in the sum of the excesses, so that changes come to an end.
    return excess < before.excess - 1e-4 && no_worse_than(before, good);
  }
};

}  // namespace carreau
