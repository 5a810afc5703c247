// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/division/place_packet.h"

#include "support/error.h"

namespace carreau {

void put_places(PacketWriter& packet, const std::vector<SurfacePlace>& places) {
  std::vector<std::int32_t> triangles, regular;
  std::vector<Vec2> uv;
  std::vector<Vec3> vectors;
  for (const SurfacePlace& p : places) {
    triangles.push_back(p.foot.triangle), regular.push_back(p.regular ? 1 : 0);
    uv.push_back(p.foot.uv);
    vectors.insert(vectors.end(), {p.xyz, p.su, p.sv, p.normal});
  }
  packet.put(triangles), packet.put(regular), packet.put(uv), packet.put(vectors);
}

std::vector<SurfacePlace> places_of(PacketReader& packet) {
  const std::vector<std::int32_t> triangles = packet.integers(), regular = packet.integers();
  const std::vector<Vec2> uv = packet.plane_points();
  const std::vector<Vec3> vectors = packet.points();
  const std::size_t n = triangles.size();
  if (regular.size() != n || uv.size() != n || vectors.size() != 4 * n)
    throw Error("another process has sent bytes that are not places of a surface");
  std::vector<SurfacePlace> places(n);
  for (std::size_t k = 0; k < n; ++k)
    places[k] = {{triangles[k], uv[k]}, vectors[4 * k], vectors[4 * k + 1], vectors[4 * k + 2], vectors[4 * k + 3], regular[k] != 0};
  return places;
}

}  // namespace carreau
