// SPDX-License-Identifier: BSD-3-Clause
// Layers of pieces end anywhere at a separator. Places the vertices near a separator again, by layers from both sides.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "plane/division/zone.h"

namespace carreau::plane {

struct Refilled {
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<Vec2> added;  ///< vertices; numbered from the number of the zone's on
};

/// The triangles of the zone; the triangles around free vertices of the innermost layers are replaced. If that fails,
/// they stay as they are.
Refilled refill(const Zone& zone, std::span<const std::uint8_t> free, const ZoneContext& context, Monitor& monitor);

}  // namespace carreau::plane
