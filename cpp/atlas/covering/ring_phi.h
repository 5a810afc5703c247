// SPDX-License-Identifier: BSD-3-Clause
// The parameter around a ring, equal for both clusters of a double zone (Atlas sec. 5.5.1.3).
#pragma once

#include "atlas/covering/ring.h"

namespace carreau::atlas {

/// Sets phi of all spokes. Triple k has its middle at k pi / 3 + pi / 6, and double zones are cut at multiples of pi /
/// 3. Between, phi is proportional to lengths of the triangles' border edges. The difference of phi from a spoke to its
/// next multiple of pi / 3 is equal for both of its clusters.
void set_phi(const Triangulation& surface, Ring& ring);

/// phi at the vertices of the inner border: phi of the middle of their spokes. Increasing.
std::vector<double> phi_of_border(const Ring& ring);

}  // namespace carreau::atlas
