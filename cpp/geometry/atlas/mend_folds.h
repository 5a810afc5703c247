// SPDX-License-Identifier: BSD-3-Clause
// Moves primitives until the blended surface is nowhere turned over.
#pragma once

#include <vector>

#include "atlas/covering/covering.h"
#include "geometry/atlas/fold_places.h"
#include "geometry/atlas/height_blend.h"
#include "geometry/atlas/primitive.h"

namespace carreau::atlas {

/// Numbers of folds found and charts moved.
struct FoldReport {
  std::size_t folded_before = 0, folded_after = 0;  ///< triangles T with a place that is turned over, or nearly
  std::size_t mended_charts = 0;
};

/// Moves primitives of charts at folds: places of a grid on a T, or given ones, where the blended surface is turned over (ours). A
/// least-squares fit combines the missing Jacobians and the distances from the initial positions; the distances'
/// weights fall from round to round. Other primitives are not changed. Deterministic.
FoldReport mend_folds(const Covering& covering, const HeightBlend& heights, std::vector<Primitive>& primitives,
                      const std::vector<PlaceOfT>& given);

}  // namespace carreau::atlas
