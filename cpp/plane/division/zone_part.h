// SPDX-License-Identifier: BSD-3-Clause
// A part of a zone as a separate triangulation, optimised.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "plane/division/zone.h"

namespace carreau::plane {

/// The changes of some triangles of a zone.
struct ZonePart {
  std::vector<std::int32_t> moved;  ///< vertices that may have
  std::vector<Vec2> to;
  std::vector<Vec2> added;  ///< vertices; numbered from the number of the zone's on
  std::vector<std::array<std::int32_t, 3>> triangles;
};

/// Optimises the triangles listed; `free`: by vertex of the zone, whether it may move. Their other vertices stay.
ZonePart optimise_part(const Zone& zone, std::span<const std::int32_t> triangles, std::span<const std::uint8_t> free,
                       const ZoneContext& context, Monitor& monitor);

}  // namespace carreau::plane
