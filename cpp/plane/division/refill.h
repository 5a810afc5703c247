// SPDX-License-Identifier: BSD-3-Clause
// Layers of pieces end anywhere at a separator. What is near it is placed anew, by layers from both sides.
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

/// The triangles of the zone, those around free vertices of the innermost layers replaced. Where that fails, as they
/// are.
Refilled refill(const Zone& zone, std::span<const std::uint8_t> free, const ZoneContext& context, Monitor& monitor);

}  // namespace carreau::plane
