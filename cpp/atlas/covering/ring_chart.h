// SPDX-License-Identifier: BSD-3-Clause
// Borders of a region in its plane, with phi at the vertices of the inner one.
#pragma once

#include "atlas/covering/frame.h"
#include "atlas/covering/ring.h"
#include "atlas/polygon.h"

namespace carreau::atlas {

struct RingChart {
  Polygon inner, outer;
  std::vector<double> phi;
};

/// The chart of a ring with phi at its spokes. If the pure zone is star-shaped, the inner border gets additional
/// vertices. The middles of spokes and triples then have equal phi in all charts that share them. Two charts agree best
/// where both have large weights.
RingChart chart_of_ring(const Triangulation& surface, const Frame& frame, const Ring& ring);

}  // namespace carreau::atlas
