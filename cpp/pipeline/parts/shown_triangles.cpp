// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/parts/shown_triangles.h"

#include <map>
#include <set>

#include "pipeline/parts/shares.h"
#include "support/ranks/packet.h"

namespace carreau {

namespace {

std::array<std::int32_t, 3> corners_of(const SurfaceMesh& mesh, const TriangleOfFace& which) {
  const FaceMesh& face = mesh.faces[static_cast<std::size_t>(which.face)];
  const auto& [a, b, c] = face.triangles[static_cast<std::size_t>(which.local)];
  return {face.vertex[a], face.vertex[b], face.vertex[c]};
}

std::map<std::int64_t, ShownTriangle::Corner> inner_vertices(PacketReader& packet) {
  std::map<std::int64_t, ShownTriangle::Corner> vertices;
  for (std::size_t n = packet.count(2 * sizeof(std::int64_t) + 3 * sizeof(double)); n > 0; --n) {
    ShownTriangle::Corner vertex{.number = packet.integer(), .ref = static_cast<std::int32_t>(packet.integer()), .xyz = {}};
    for (int axis = 0; axis < 3; ++axis) vertex.xyz[axis] = packet.real();
    vertices.emplace(vertex.number, vertex);
  }
  return vertices;
}

}  // namespace

std::string show_triangles(const SurfaceMesh& mesh, const MeshShares& shares, std::span<const TriangleOfFace> triangles) {
  const PartVertices numbers(shares);
  std::set<std::int32_t> inside;
  for (const TriangleOfFace& t : triangles)
    for (const std::int32_t v : corners_of(mesh, t))
      if (v >= shares.on_curves) inside.insert(v);
  PacketWriter packet;
  packet.put(static_cast<std::int64_t>(inside.size()));
  for (const std::int32_t v : inside) {
    packet.put(numbers.in_mesh(v));
    packet.put(std::int64_t{mesh.vertex_ref[static_cast<std::size_t>(v)]});
    for (int axis = 0; axis < 3; ++axis) packet.put(mesh.vertices[static_cast<std::size_t>(v)][axis]);
  }
  packet.put(static_cast<std::int64_t>(triangles.size()));
  for (const TriangleOfFace& t : triangles) {
    packet.put(std::int64_t{t.face}), packet.put(std::int64_t{t.local});
    for (const std::int32_t v : corners_of(mesh, t)) packet.put(numbers.in_mesh(v));
  }
  return packet.take();
}

void for_shown_triangles(const std::string& bytes, const SurfaceMesh& mesh, const MeshShares& shares,
                         const std::function<void(const ShownTriangle&)>& use) {
  PacketReader packet(bytes);
  const std::map<std::int64_t, ShownTriangle::Corner> inside = inner_vertices(packet);
  for (std::size_t n = packet.count(5 * sizeof(std::int64_t)); n > 0; --n) {
    ShownTriangle triangle;
    triangle.which.face = static_cast<std::int32_t>(packet.integer());
    triangle.which.local = static_cast<std::int32_t>(packet.integer());
    for (ShownTriangle::Corner& corner : triangle.corners) {
      const std::int64_t number = packet.integer();
      if (number >= shares.on_curves) {
        corner = inside.at(number);
        continue;
      }
      const auto v = static_cast<std::size_t>(number);
      corner = {.number = number, .ref = mesh.vertex_ref[v], .xyz = mesh.vertices[v]};
    }
    use(triangle);
  }
}

}  // namespace carreau
