// SPDX-License-Identifier: BSD-3-Clause
// Triangles as bytes and back: four bytes a corner.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "support/ranks/packet.h"

namespace carreau {

using TriangleList = std::vector<std::array<std::int32_t, 3>>;

inline void put_triangles(PacketWriter& packet, const TriangleList& triangles) {
  constexpr std::size_t each = sizeof(TriangleList::value_type);
  static_assert(each == 3 * sizeof(std::int32_t));
  packet.put(std::string_view(reinterpret_cast<const char*>(triangles.data()), each * triangles.size()));
}

/// Throws Error for bytes that are no triangles.
inline TriangleList triangles_of(PacketReader& packet) {
  constexpr std::size_t each = sizeof(TriangleList::value_type);
  const std::string bytes = packet.text();
  if (bytes.size() % each != 0) throw Error("another process has sent bytes that are not triangles");
  TriangleList triangles(bytes.size() / each);
  if (!triangles.empty()) std::memcpy(triangles.data(), bytes.data(), bytes.size());
  return triangles;
}

}  // namespace carreau
