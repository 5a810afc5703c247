// SPDX-License-Identifier: BSD-3-Clause
#include "surface/lift/lift.h"

#include <span>

#include "cad/batches.h"
#include "support/ranks/shared_answers.h"

namespace carreau {

namespace {

std::vector<double> shared_positions(const PatchInput& input, Cad& cad, std::span<const Vec2> uv, Monitor& monitor) {
  const auto ask = [&](std::span<const Vec2> some, double* out, Monitor& of_piece) {
    for_batches(cad, input.ref, want_position, some, of_piece,
                [&](std::size_t first, std::span<const Vec2>, std::span<const SurfaceJet> jets) {
                  for (std::size_t k = 0; k < jets.size(); ++k) Eigen::Map<Vec3>(out + 3 * (first + k)) = jets[k].s;
                });
  };
  return shared_answers(input.executor, input.ref, {"positions", 3, input.host_threads, ask}, uv, monitor);
}

}  // namespace

void lift_patch(const PatchInput& input, Cad& cad, PatchMesh& mesh, Monitor& monitor) {
  const std::size_t imposed = input.curve_xyz.size();
  mesh.xyz.reserve(mesh.plane.vertices.size());
  mesh.xyz = input.curve_xyz;
  mesh.xyz.resize(mesh.plane.vertices.size());
  const std::span<const Vec2> uv = std::span<const Vec2>(mesh.plane.vertices).subspan(imposed);
  if (!input.is_plane && is_shared(input.executor, uv.size())) {
    const std::vector<double> xyz = shared_positions(input, cad, uv, monitor);
    for (std::size_t k = 0; k < uv.size(); ++k) mesh.xyz[imposed + k] = Eigen::Map<const Vec3>(xyz.data() + 3 * k);
    return;
  }
  for_batches(cad, input.ref, want_position, uv, input.host_threads, monitor,
              [&](std::size_t first, std::span<const Vec2>, std::span<const SurfaceJet> jets) {
                for (std::size_t k = 0; k < jets.size(); ++k) mesh.xyz[imposed + first + k] = jets[k].s;
              });
}

}  // namespace carreau
