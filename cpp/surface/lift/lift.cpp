// SPDX-License-Identifier: BSD-3-Clause
#include "surface/lift/lift.h"

#include <span>

#include "cad/batches.h"

namespace carreau {

void lift_patch(const PatchInput& input, Cad& cad, PatchMesh& mesh, Monitor& monitor) {
  mesh.xyz.reserve(mesh.plane.vertices.size());
  mesh.xyz = input.curve_xyz;
  const std::span<const Vec2> inside = std::span(mesh.plane.vertices).subspan(mesh.xyz.size());
  for_batches(cad, input.ref, want_position, inside, monitor,
              [&](std::size_t, std::span<const Vec2>, std::span<const SurfaceJet> jets) {
                for (const SurfaceJet& jet : jets) mesh.xyz.push_back(jet.s);
              });
}

}  // namespace carreau
