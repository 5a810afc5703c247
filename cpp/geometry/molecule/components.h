// SPDX-License-Identifier: BSD-3-Clause
// Loops of arcs, and the loops that bound one exposed part. A step of arrange().
#pragma once

#include "geometry/molecule/arrangement.h"

namespace carreau::molecule {

/// Fills `components` from the other members. Returns false when arcs do not close to loops, which only wrong decisions
/// can cause.
bool find_components(const Neighbours& neighbours, Arrangement& arrangement);

}  // namespace carreau::molecule
