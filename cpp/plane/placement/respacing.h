// SPDX-License-Identifier: BSD-3-Clause
// A layer keeps the number of points of the previous layer; if the metric requires more or fewer, some are added or
// merged.
#pragma once

#include <vector>

#include "plane/placement/insertion.h"

namespace carreau::plane {

/// Candidates of one layer of the advancing front.
struct Layer {
  double strain_limit;                 ///< misfit, in edges, that makes a point more or less
  std::vector<Candidate> chain = {};   ///< on edges of the front that follow each other
  std::vector<Candidate> points = {};  ///< of the chains so far, respaced
  std::vector<Candidate> spaced = {};  ///< scratch
  std::vector<double> gaps = {};       ///< scratch
};

[[nodiscard]] double strain_limit(const Field& field);

/// Moves the chain to the points. Apexes that nearly coincide are merged, wide gaps are corners to go round, and the
/// misfit of the gaps is summed up. `closed`: the last edge is followed by the first.
void respace(const Placement& placement, Layer& layer, bool closed);

}  // namespace carreau::plane
