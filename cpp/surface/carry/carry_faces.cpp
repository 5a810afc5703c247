// SPDX-License-Identifier: BSD-3-Clause
#include "surface/carry/carry_faces.h"

#include <cstddef>

#include "periodic/closest.h"
#include "surface/carry/carry_patch.h"

namespace carreau {

namespace {

// Corner i of a triangle is the image of this corner of the master's.
std::size_t corner_of(std::size_t i, bool flipped) { return flipped ? (3 - i) % 3 : i; }

}  // namespace

std::vector<std::int32_t> local_images(const FaceMesh& from, const FaceMesh& to, bool flipped) {
  std::vector<std::int32_t> image(from.uv.size(), -1);
  const auto join = [&](const std::array<std::int32_t, 3>& t, const std::array<std::int32_t, 3>& u) {
    for (std::size_t i = 0; i < 3; ++i) image[t[corner_of(i, flipped)]] = u[i];
  };
  for (std::size_t t = 0; t < from.triangles.size() && from.triangles.size() == to.triangles.size(); ++t)
    join(from.triangles[t], to.triangles[image_triangle(from, t, flipped)]);
  for (std::size_t t = 0; t < from.flattened.size() && from.flattened.size() == to.flattened.size(); ++t)
    join(from.flattened[t], to.flattened[t]);
  return image;
}

void carry_elements(const FaceMesh& from, const std::vector<std::int32_t>& vertex, bool flipped, FaceMesh& to) {
  to.quads = from.quads;
  to.triangles.resize(from.triangles.size());
  for (std::size_t t = 0; t < from.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      to.triangles[image_triangle(from, t, flipped)][i] = vertex[from.triangles[t][corner_of(i, flipped)]];
  // Halves of a quadrilateral (a, b, c, d) are (a, b, c) and (a, c, d); images of these corners are (a, d, c) and (a, c, b).
}

void carry_mids(const FaceMesh& from, bool flipped, FaceMesh& to) {
  to.mid.resize(from.mid.size());
  for (std::size_t t = 0; t < from.mid.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) to.mid[image_triangle(from, t, flipped)][flipped ? 2 - i : i] = from.mid[t][i];
}

void follow_master(Cad& cad, const FacePair& pair, const std::vector<char>& fixed, const std::vector<char>& fixed_mids, double exact,
                   SurfaceMesh& mesh) {
  const FaceMesh& from = mesh.faces[pair.master];
  FaceMesh& to = mesh.faces[pair.slave];
  const std::vector<std::int32_t> image = local_images(from, to, pair.flipped);
  std::vector<Vec3> targets;
  std::vector<ClosestPoint> points;
  std::vector<std::int32_t> vertices, mids;
  for (std::size_t v = 0; v < image.size(); ++v) {
    if (image[v] < 0 || fixed[image[v]] != 0) continue;
    vertices.push_back(image[v]);
    targets.push_back(pair.map(mesh.vertices[from.vertex[v]]));
    points.push_back({to.uv[image[v]], {}, 0});
  }
  std::vector<char> done(to.mid_uv.size(), 0);
  for (std::size_t t = 0; t < from.mid.size() && from.mid.size() == to.mid.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t mid = from.mid[t][i], there = to.mid[image_triangle(from, t, pair.flipped)][pair.flipped ? 2 - i : i];
      if (mid < 0 || there < 0 || fixed_mids[there] != 0 || done[there] != 0) continue;
      done[there] = 1;
      mids.push_back(there);
      targets.push_back(pair.map(mesh.mid_vertices[from.mid_vertex[mid]]));
      points.push_back({to.mid_uv[there], {}, 0});
    }
  find_closest(cad, to.ref, targets, points);
  const auto place = [&](std::size_t k, Vec2& uv, Vec3& xyz) {
    uv = points[k].uv, xyz = points[k].distance <= exact ? targets[k] : points[k].xyz;
  };
  for (std::size_t k = 0; k < vertices.size(); ++k) place(k, to.uv[vertices[k]], mesh.vertices[to.vertex[vertices[k]]]);
  for (std::size_t k = 0; k < mids.size(); ++k)
    place(vertices.size() + k, to.mid_uv[mids[k]], mesh.mid_vertices[to.mid_vertex[mids[k]]]);
}

}  // namespace carreau
