#include "surface/lift/lift.h"

#include <algorithm>
#include <span>

namespace carreau {

namespace {

// Points to evaluate at a time: large enough for hosts that like batches, small enough to stop soon.
constexpr std::size_t batch = 512;

// Of the vertices from `xyz.size()` on.
void lift(int face, std::span<const Vec2> uv, Cad& cad, std::vector<Vec3>& xyz, Monitor& monitor) {
  std::vector<SurfaceJet> jets(batch);
  for (std::size_t i = xyz.size(); i < uv.size(); i += batch) {
    monitor.checkpoint();
    const std::size_t n = std::min(batch, uv.size() - i);
    cad.surface(face, want_position, uv.subspan(i, n), std::span(jets).first(n));
    for (std::size_t k = 0; k < n; ++k) xyz.push_back(jets[k].s);
  }
}

}  // namespace

void lift_patch(const PatchInput& input, Cad& cad, PatchMesh& mesh, Monitor& monitor) {
  mesh.xyz.reserve(mesh.plane.vertices.size());
  mesh.xyz = input.curve_xyz;
  lift(input.ref, mesh.plane.vertices, cad, mesh.xyz, monitor);
}

}  // namespace carreau
