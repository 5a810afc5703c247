// SPDX-License-Identifier: BSD-3-Clause
// Primitives moved until the blended surface is nowhere turned over.
#pragma once

#include <vector>

#include "atlas/covering/covering.h"
#include "geometry/atlas/primitive.h"

namespace carreau::atlas {

/// What the mend found and did.
struct FoldReport {
  std::size_t folded_before = 0, folded_after = 0;  ///< triangles T with a place that is turned over, or nearly
  std::size_t mended_charts = 0;
};

/// Where the blended surface is turned over at a place of a fine grid on a T (ours), primitives of the charts there are
/// moved, by least squares of what is missing and of distances to where they were, which count less the longer it
/// takes. Those elsewhere are left as they are. Deterministic.
FoldReport mend_folds(const Covering& covering, std::vector<Primitive>& primitives);

}  // namespace carreau::atlas
