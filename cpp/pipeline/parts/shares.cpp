// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/parts/shares.h"

#include <algorithm>

#include "pipeline/parts/part_mesh.h"
#include "support/ranks/packet.h"
#include "support/ranks/team.h"

namespace carreau {

namespace {

/// The domain's vertices on curves, which all processes have.
std::size_t vertices_on_curves(const FaceDomain& domain) {
  return static_cast<std::size_t>(std::count_if(domain.origin.begin(), domain.origin.end(), [](const DomainVertexOrigin& origin) {
    return origin.corner >= 0 || origin.curve >= 0;
  }));
}

std::string own_counts(const CompositeRun& run, int rank) {
  PacketWriter packet;
  for (std::size_t f = 0; f < run.keeper.size(); ++f) {
    if (run.keeper[f] != rank) continue;
    const FaceMesh& face = run.result.mesh.faces[f];
    packet.put(static_cast<std::int64_t>(f));
    packet.put(static_cast<std::int64_t>(face.vertex.size() - vertices_on_curves(*run.domains.domain[f])));
    packet.put(static_cast<std::int64_t>(face.triangles.size()));
  }
  return packet.take();
}

}  // namespace

void share_sentences(Team& team, std::vector<std::string>& of_face) {
  PacketWriter packet;
  for (std::size_t f = 0; f < of_face.size(); ++f)
    if (!of_face[f].empty()) packet.put(static_cast<std::int64_t>(f)), packet.put(std::string_view(of_face[f]));
  for (const std::string& of_rank : team.exchange("faces that failed", packet.bytes()))
    for (PacketReader reader(of_rank); !reader.at_end();) {
      const auto f = static_cast<std::size_t>(reader.integer());
      of_face.at(f) = reader.text();
    }
}

MeshShares share_out(const CompositeRun& run) {
  Team& team = *run.options.executor.team;
  MeshShares shares{.rank = team.rank(), .processes = team.size(), .of_face = std::vector<FaceShare>(run.keeper.size())};
  shares.on_curves = static_cast<std::int64_t>(run.result.mesh.vertices.size());
  const std::vector<std::string> all = team.exchange("shares", own_counts(run, team.rank()));
  for (std::size_t rank = 0; rank < all.size(); ++rank)
    for (PacketReader reader(all[rank]); !reader.at_end();) {
      FaceShare& share = shares.of_face.at(static_cast<std::size_t>(reader.integer()));
      share.rank = static_cast<int>(rank);
      share.vertices = reader.integer(), share.triangles = reader.integer();
      if (share.rank == team.rank()) shares.on_curves -= share.vertices;
    }
  shares.vertices = shares.on_curves;
  for (FaceShare& share : shares.of_face) {
    share.first_vertex = shares.vertices, share.first_triangle = shares.triangles;
    shares.vertices += share.vertices, shares.triangles += share.triangles;
  }
  return shares;
}

PartVertices::PartVertices(const MeshShares& shares) : runs_{{0, 0}} {
  std::int64_t here = shares.on_curves;
  for (const FaceShare& share : shares.of_face) {
    if (share.rank != shares.rank || share.vertices == 0) continue;
    runs_.push_back({here, share.first_vertex});
    here += share.vertices;
  }
}

std::int64_t PartVertices::in_mesh(std::int32_t vertex) const {
  const auto next = std::upper_bound(runs_.begin(), runs_.end(), vertex, [](std::int64_t v, const Run& run) { return v < run.here; });
  return (next - 1)->in_mesh + (vertex - (next - 1)->here);
}

std::vector<int> owners_on_curves(const SurfaceMesh& mesh, const MeshShares& shares) {
  std::vector<int> owner(static_cast<std::size_t>(shares.on_curves), shares.processes);
  for (const CurveMesh& curve : mesh.curves)
    for (const CurveMeshUse& use : curve.uses) {
      const int rank = shares.of_face[static_cast<std::size_t>(use.face)].rank;
      if (rank < 0) continue;
      for (const std::int32_t v : curve.vertices) owner[static_cast<std::size_t>(v)] = std::min(owner[static_cast<std::size_t>(v)], rank);
    }
  std::replace(owner.begin(), owner.end(), shares.processes, 0);
  return owner;
}

}  // namespace carreau
