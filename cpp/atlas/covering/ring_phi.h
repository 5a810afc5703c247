// SPDX-License-Identifier: BSD-3-Clause
// The parameter around a ring, the same for both clusters of a double zone (Atlas sec. 5.5.1.3).
#pragma once

#include "atlas/covering/ring.h"

namespace carreau::atlas {

/// Sets phi of all spokes: triple k has its middle at k pi / 3 + pi / 6, double zones are cut at multiples of pi / 3,
/// and phi is proportional to lengths of the triangles' border edges between. A spoke has phi to its next multiple of
/// pi / 3 the same for both of its clusters.
void set_phi(const Triangulation& surface, Ring& ring);

/// phi at the vertices of the inner border: that of the middle of their spokes. Increasing.
std::vector<double> phi_of_border(const Ring& ring);

}  // namespace carreau::atlas
