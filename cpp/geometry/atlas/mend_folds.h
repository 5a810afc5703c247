// SPDX-License-Identifier: BSD-3-Clause
// Primitives that agree with their neighbours where the blended surface would fold.
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

/// Where the blended surface is turned over at a place of a grid on a T (ours), primitives of the charts around are
/// fitted to one another as well as to their vertices, the more the longer it stays so. Those elsewhere are left as
/// they are. Deterministic.
FoldReport mend_folds(const Covering& covering, std::vector<Primitive>& primitives);

}  // namespace carreau::atlas
