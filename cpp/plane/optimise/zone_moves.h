// SPDX-License-Identifier: BSD-3-Clause
// Moves and swaps by which a zone makes the best of a change.
#pragma once

#include "plane/optimise/search_zone.h"

namespace carreau::plane {

/// Swaps and moves, each kept if it costs less. `quick`: estimates the gain of a change.
void relax_zone(SearchZone& zone, bool quick);

}  // namespace carreau::plane
