// SPDX-License-Identifier: BSD-3-Clause
#include "surface/lift/lift.h"

#include <span>

#include "cad/batches.h"

namespace carreau {

void lift_patch(const PatchInput& input, Cad& cad, PatchMesh& mesh, Monitor& monitor) {
  const std::size_t imposed = input.curve_xyz.size();
  mesh.xyz.reserve(mesh.plane.vertices.size());
  mesh.xyz = input.curve_xyz;
  mesh.xyz.resize(mesh.plane.vertices.size());
  for_batches(cad, input.ref, want_position, std::span<const Vec2>(mesh.plane.vertices).subspan(imposed),
              input.host_threads, monitor,
              [&](std::size_t first, std::span<const Vec2>, std::span<const SurfaceJet> jets) {
                for (std::size_t k = 0; k < jets.size(); ++k) mesh.xyz[imposed + first + k] = jets[k].s;
              });
}

}  // namespace carreau
