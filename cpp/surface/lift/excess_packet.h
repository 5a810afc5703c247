// SPDX-License-Identifier: BSD-3-Clause
// Edges that exceed their promise as bytes for another process, and back.
#pragma once

#include <vector>

#include "support/ranks/packet.h"
#include "surface/patch.h"

namespace carreau {

inline void put_excesses(PacketWriter& packet, const std::vector<EdgeExcess>& excesses) {
  packet.put(static_cast<std::int64_t>(excesses.size()));
  for (const EdgeExcess& e : excesses) packet.put(e.ratio), packet.put(e.from), packet.put(e.to);
}

inline std::vector<EdgeExcess> excesses_of(PacketReader& packet) {
  std::vector<EdgeExcess> excesses(packet.count(5 * sizeof(double)));
  for (EdgeExcess& e : excesses) e.ratio = packet.real(), e.from = packet.plane_point(), e.to = packet.plane_point();
  return excesses;
}

}  // namespace carreau
