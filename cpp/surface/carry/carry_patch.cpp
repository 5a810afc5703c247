// SPDX-License-Identifier: BSD-3-Clause
#include "surface/carry/carry_patch.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "periodic/closest.h"
#include "periodic/thresholds.h"
#include "predicates/predicates.h"
#include "support/format.h"
#include "model/format_point.h"
#include "support/rounding_of.h"
#include "surface/carry/image_vertices.h"

namespace carreau {

namespace {


Vec3 surface_point(const CurveModel& model, int face, const Vec2& uv) {
  return surface_at(model.cad, model.model.faces[face].ref, want_position, uv).s;
}

// Half of the longest side as the size at all sides.
void ask_finer(const std::array<std::int32_t, 3>& t, const PatchMesh& mesh, std::vector<EdgeSizes::Source>& finer) {
  double longest = 0;
  for (int i = 0; i < 3; ++i) longest = std::max(longest, norm(mesh.xyz[t[(i + 1) % 3]] - mesh.xyz[t[i]]));
  for (int i = 0; i < 3; ++i) finer.push_back({mesh.xyz[t[i]], mesh.xyz[t[(i + 1) % 3]], longest / 2});
}

}  // namespace

CarriedPatch carry_patch(const CurveModel& model, const std::vector<DiscreteCurve>& curves, const FacePair& pair,
                         const FaceDomain& master, const FaceDomain& slave, const PatchMesh& mesh, double gap) {
  CarriedPatch carried;
  const DomainMap map = map_domain(model, curves, pair, master, slave, gap);
  if (!map.why.empty()) {
    carried.failure = map.why;
    return carried;
  }
  carried.flipped = map.flipped;
  const std::size_t imposed = slave.origin.size(), n = mesh.plane.vertices.size();
  PatchMesh& image = carried.mesh;
  image.plane.vertices = slave.plane.vertices;
  image.plane.vertices.resize(n);
  image.xyz = positions_on_curves(slave, curves, model.topology);
  for (std::size_t v = image.xyz.size(); v < imposed; ++v) image.xyz.push_back(surface_point(model, pair.slave, slave.plane.vertices[v]));
  image.xyz.resize(n);
  const auto there = [&](std::int32_t v) { return static_cast<std::size_t>(v) < imposed ? map.vertex[v] : v; };
  image.size.resize(mesh.size.size());
  for (std::size_t v = 0; v < mesh.size.size(); ++v) image.size[there(static_cast<std::int32_t>(v))] = mesh.size[v];
  const bool across = map.flipped != pair.map.reflects();
  image.normal.resize(mesh.normal.size());
  for (std::size_t v = 0; v < mesh.normal.size(); ++v) {
    const Vec3 turned = pair.map.turn(mesh.normal[v]);
    image.normal[there(static_cast<std::int32_t>(v))] = across ? Vec3(-turned) : turned;
  }
  for (const auto& [a, b, c] : mesh.plane.triangles)
    image.plane.triangles.push_back({there(a), there(map.flipped ? c : b), there(map.flipped ? b : c)});

  ImageVertices vertices{.cad = model.cad, .face = model.model.faces[pair.slave].ref, .target = std::vector<Vec3>(n),
                         .from_uv = std::vector<Vec2>(n), .known = std::vector<char>(n, 0)};
  for (std::size_t v = 0; v < n; ++v) {
    const std::int32_t w = there(static_cast<std::int32_t>(v));
    vertices.target[w] = pair.map(mesh.xyz[v]), vertices.from_uv[w] = mesh.plane.vertices[v];
    vertices.known[w] = v < imposed ? 1 : 0;
  }
  const MissedVertex missed =
      place_images(vertices, image.plane.triangles, rounding_of::places * gap, image.plane.vertices, image.xyz);
  if (missed.distance > gap) {
    carried.failure = "the image of the mesh of face " + std::to_string(model.model.faces[pair.master].ref) + " is " +
                      format_number(missed.distance) + " away from the surface at " + format_point(image.xyz[missed.vertex]);
    return carried;
  }
  std::size_t turned = 0;
  Vec3 where(0, 0, 0);
  for (std::size_t t = 0; t < image.plane.triangles.size(); ++t) {
    const auto [a, b, c] = image.plane.triangles[t];
    const std::vector<Vec2>& uv = image.plane.vertices;
    if (orientation(uv[a], uv[b], uv[c]) > 0) continue;
    if (turned++ == 0) where = image.xyz[a];
    ask_finer(mesh.plane.triangles[t], mesh, carried.finer);
  }
  if (turned > 0)
    carried.failure = std::to_string(turned) + (turned == 1 ? " triangle" : " triangles") + " of the image of the mesh of face " +
                      std::to_string(model.model.faces[pair.master].ref) + (turned == 1 ? " is" : " are") +
                      " turned over in (u, v), the first one at " + format_point(where);
  return carried;
}

}  // namespace carreau
