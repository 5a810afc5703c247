// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/parts/part_crossings.h"

#include <algorithm>
#include <utility>

#include "mesh/crossings/shared_search.h"
#include "pipeline/parts/near_triangles.h"
#include "support/ranks/packet.h"
#include "support/ranks/team.h"

namespace carreau {

namespace {

struct Pair {
  TriangleOfFace first, second;
  Vec3 place;
  friend bool operator<(const Pair& a, const Pair& b) noexcept {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  }
};

void put(PacketWriter& packet, const TriangleOfFace& which) {
  packet.put(std::int64_t{which.face}), packet.put(std::int64_t{which.local});
}
TriangleOfFace get(PacketReader& packet) {
  const auto face = static_cast<std::int32_t>(packet.integer());
  return {face, static_cast<std::int32_t>(packet.integer())};
}
void put(PacketWriter& packet, const Vec3& place) {
  for (int axis = 0; axis < 3; ++axis) packet.put(place[axis]);
}
Vec3 point_of(PacketReader& packet) {
  Vec3 place;
  for (int axis = 0; axis < 3; ++axis) place[axis] = packet.real();
  return place;
}

std::string found_here(const CompositeRun& run, std::size_t limit) {
  const NearTriangles near = near_triangles(run);
  const Intersections found =
      find_intersections_of(near.vertices, near.triangles, near.own, limit, run.options.executor.threads, run.monitor);
  PacketWriter packet;
  packet.put(found.count);
  packet.put(static_cast<std::int64_t>(found.pairs.size()));
  for (const TriangleIntersection& pair : found.pairs) {
    for (const std::int32_t t : pair.triangles) put(packet, near.origin(t));
    put(packet, pair.place);
  }
  return packet.take();
}

/// The first `limit` of all.
std::vector<Pair> pairs_of_all(Team& team, const std::string& mine, std::size_t limit, std::int64_t& count) {
  std::vector<Pair> pairs;
  count = 0;
  for (const std::string& of_rank : team.exchange("triangles that cross", mine)) {
    PacketReader packet(of_rank);
    count += packet.integer();
    for (std::size_t n = packet.count(4 * sizeof(std::int64_t) + 3 * sizeof(double)); n > 0; --n) {
      Pair& pair = pairs.emplace_back();
      pair.first = get(packet), pair.second = get(packet), pair.place = point_of(packet);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.resize(std::min(pairs.size(), limit));
  return pairs;
}

std::vector<TriangleOfFace> triangles_of(const std::vector<Pair>& pairs) {
  std::vector<TriangleOfFace> all;
  for (const Pair& pair : pairs) all.insert(all.end(), {pair.first, pair.second});
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// The corners that this process owns: number of a vertex on curves or -1, place, (u, v).
std::string corners_here(const CompositeRun& run, const std::vector<TriangleOfFace>& triangles) {
  const MeshShares& shares = *run.result.shares;
  PacketWriter packet;
  for (const TriangleOfFace& each : triangles) {
    if (shares.of_face[static_cast<std::size_t>(each.face)].rank != shares.rank) continue;
    const FaceMesh& face = run.result.mesh.faces[static_cast<std::size_t>(each.face)];
    put(packet, each);
    for (const std::int32_t local : face.triangles[static_cast<std::size_t>(each.local)]) {
      const std::int32_t v = face.vertex[static_cast<std::size_t>(local)];
      packet.put(std::int64_t{v < shares.on_curves ? v : -1});
      put(packet, run.result.mesh.vertices[static_cast<std::size_t>(v)]);
      packet.put(face.uv[static_cast<std::size_t>(local)]);
    }
  }
  return packet.take();
}

struct Corner {
  std::int32_t on_curve = -1;
  Vec3 xyz;
  Vec2 uv;
};
using TriangleCorners = std::array<Corner, 3>;

/// Corners of the triangles of the list, from all processes.
std::vector<TriangleCorners> corners_of_all(const CompositeRun& run, const std::vector<TriangleOfFace>& triangles) {
  std::vector<TriangleCorners> all(triangles.size());
  for (const std::string& of_rank : run.options.executor.team->exchange("corners of triangles that cross", corners_here(run, triangles)))
    for (PacketReader packet(of_rank); !packet.at_end();) {
      const auto found = std::lower_bound(triangles.begin(), triangles.end(), get(packet));
      for (Corner& corner : all.at(static_cast<std::size_t>(found - triangles.begin()))) {
        corner.on_curve = static_cast<std::int32_t>(packet.integer());
        corner.xyz = point_of(packet), corner.uv = packet.plane_point();
      }
    }
  return all;
}

// Leaves out members of faces that no caller reads.
SurfaceMesh empty_faces(const CompositeRun& run) {
  SurfaceMesh mesh;
  const SurfaceMesh& whole = run.result.mesh;
  mesh.curves = whole.curves;
  mesh.vertices.assign(whole.vertices.begin(), whole.vertices.begin() + run.result.shares->on_curves);
  for (const FaceMesh& face : whole.faces) mesh.faces.emplace_back().ref = face.ref;
  for (const CurveMesh& curve : mesh.curves)
    for (const CurveMeshUse& use : curve.uses) {
      FaceMesh& face = mesh.faces[static_cast<std::size_t>(use.face)];
      face.vertex.insert(face.vertex.end(), curve.vertices.begin(), curve.vertices.end());
      face.uv.resize(face.vertex.size());
    }
  return mesh;
}

void add_triangle(const TriangleCorners& corners, FaceMesh& face, SurfaceMesh& mesh) {
  auto& triangle = face.triangles.emplace_back();
  for (std::size_t k = 0; k < 3; ++k) {
    triangle[k] = static_cast<std::int32_t>(face.vertex.size());
    face.uv.push_back(corners[k].uv);
    face.vertex.push_back(corners[k].on_curve >= 0 ? corners[k].on_curve : static_cast<std::int32_t>(mesh.vertices.size()));
    if (corners[k].on_curve < 0) mesh.vertices.push_back(corners[k].xyz);
  }
}

}  // namespace

PartCrossings find_part_crossings(const CompositeRun& run, std::size_t limit) {
  PartCrossings crossings;
  const std::vector<Pair> pairs = pairs_of_all(*run.options.executor.team, found_here(run, limit), limit, crossings.found.count);
  const std::vector<TriangleOfFace> triangles = triangles_of(pairs);
  const std::vector<TriangleCorners> corners = corners_of_all(run, triangles);
  crossings.mesh = empty_faces(run);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    add_triangle(corners[t], crossings.mesh.faces[static_cast<std::size_t>(triangles[t].face)], crossings.mesh);
  const auto number = [&](const TriangleOfFace& each) {
    return static_cast<std::int32_t>(std::lower_bound(triangles.begin(), triangles.end(), each) - triangles.begin());
  };
  for (const Pair& pair : pairs) crossings.found.pairs.push_back({{number(pair.first), number(pair.second)}, pair.place});
  return crossings;
}

}  // namespace carreau
