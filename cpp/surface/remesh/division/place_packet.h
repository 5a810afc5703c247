// SPDX-License-Identifier: BSD-3-Clause
// Places of a surface as bytes and back.
#pragma once

#include <vector>

#include "support/ranks/packet.h"
#include "surface/surface_place.h"

namespace carreau {

void put_places(PacketWriter& packet, const std::vector<SurfacePlace>& places);
/// Throws Error for bytes that do not hold places.
std::vector<SurfacePlace> places_of(PacketReader& packet);

}  // namespace carreau
