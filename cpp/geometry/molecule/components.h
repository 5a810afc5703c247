// SPDX-License-Identifier: BSD-3-Clause
// Loops of arcs, and which of them bound one exposed part. A step of arrange().
#pragma once

#include "geometry/molecule/arrangement.h"

namespace carreau::molecule {

/// Fills `components` from all else. False when arcs do not close to loops, which only wrong decisions can bring about.
bool find_components(const Neighbours& neighbours, Arrangement& arrangement);

}  // namespace carreau::molecule
