// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/faces/same_hosts.h"

#include <algorithm>

#include "support/ranks/packet.h"
#include "support/ranks/shared_answers.h"

namespace carreau {

namespace {

constexpr std::size_t digits = 16;            // of a checksum
constexpr std::size_t vertices_of_patch = 4;  // that hosts are compared at

std::string checksum_of(const DiscreteCurve& curve) {
  PacketWriter packet;
  packet.put(curve.xyz);
  packet.put(curve.size);
  for (const std::vector<double>& t : curve.t_of_use) packet.put(t);
  for (const std::vector<Vec2>& uv : curve.uv_of_use) packet.put(uv);
  return checksum(packet.bytes());
}

/// Index of the first checksum in which two lists differ; the length of the shorter list if none does.
std::size_t first_other(const std::string& a, const std::string& b) {
  const auto differ = std::mismatch(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(std::min(a.size(), b.size())), b.begin());
  return static_cast<std::size_t>(differ.first - a.begin()) / digits;
}

/// Some vertices inside a patch, whose first `imposed` ones lie on its boundary.
std::vector<Vec2> places_in(const PatchMesh& patch, std::size_t imposed) {
  const std::vector<Vec2>& all = patch.plane.vertices;
  const std::size_t inside = all.size() - std::min(imposed, all.size()), n = std::min(inside, vertices_of_patch);
  std::vector<Vec2> places;
  for (std::size_t k = 0; k < n; ++k) places.push_back(all[imposed + k * inside / n]);
  return places;
}

// Packs the answers of the host at these places. An error counts as an answer.
std::string answers(const CompositeRun& run, std::size_t f, const std::vector<Vec2>& uv) {
  PacketWriter packet;
  try {
    std::vector<SurfaceJet> jets(uv.size());
    const int ref = run.model.faces[f].ref;
    run.cad.surface(ref, want_position | want_first | run.rules.surface_wants(), uv, jets);
    for (const SurfaceJet& jet : jets) packet.put(std::vector<Vec3>{jet.s});
    if (run.rules.constant()) return packet.take();
    const auto none = [](Vec2) { return 1.; };
    std::vector<Metric2> metrics(uv.size());
    run.rules.on_surface(static_cast<int>(f), uv, jets, none, metrics);
    for (const Metric2& m : metrics) packet.put(m.a), packet.put(m.b), packet.put(m.c);
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    packet.put(std::string_view(error.what()));
  }
  return packet.take();
}

/// Places in the patches of all processes, by face.
std::vector<std::vector<Vec2>> places_in_patches(Team& team, const CompositeRun& run) {
  std::vector<std::vector<Vec2>> places(run.patches.size());
  PacketWriter packet;
  for (std::size_t f = 0; f < run.patches.size(); ++f) {
    if (!run.patches[f] || !run.domains.domain[f]) continue;
    places[f] = places_in(*run.patches[f], run.domains.domain[f]->plane.vertices.size());
    if (run.options.parts) packet.put(static_cast<std::int64_t>(f)), packet.put(places[f]);
  }
  if (!run.options.parts) return places;
  for (const std::string& of_rank : team.exchange("places", packet.bytes()))
    for (PacketReader reader(of_rank); !reader.at_end();) {
      const auto f = static_cast<std::size_t>(reader.integer());
      places.at(f) = reader.plane_points();
    }
  return places;
}

}  // namespace

std::int64_t least_of(Team& team, std::int64_t max_triangles) {
  PacketWriter packet;
  packet.put(max_triangles);
  for (const std::string& of_rank : team.exchange("begin", packet.bytes()))
    max_triangles = std::min(max_triangles, PacketReader(of_rank).integer());
  return max_triangles;
}

void require_same_curves(Team& team, const CompositeRun& run) {
  std::string sums;
  for (const DiscreteCurve& curve : run.curves) sums += checksum_of(curve);
  const std::vector<std::string> all = team.exchange("curves", sums);
  for (std::size_t r = 1; r < all.size(); ++r) {
    if (all[r] == all[0]) continue;
    const std::size_t c = first_other(all[0], all[r]);
    const std::string which =
        c < run.topology.curves.size() ? "curve " + std::to_string(run.topology.curves[c].ref) : "the number of curves";
    throw InvalidModel(which + " differs on rank " + std::to_string(r) +
                       " from rank 0: its callbacks or parameters differ; all ranks must mesh the same model");
  }
}

void require_same_mesh(Team& team, const SurfaceMesh& mesh) {
  LongChecksum sum;
  sum.add(mesh.vertices);
  sum.add(mesh.mid_vertices);
  sum.add(mesh.vertex_ref);
  for (const FaceMesh& face : mesh.faces) {
    sum.add(static_cast<std::uint64_t>(face.status));
    sum.add(face.vertex);
    sum.add(face.uv);
    sum.add(face.triangles);
  }
  team.require_same("mesh", sum.text(), [](int rank) {
    return "the mesh of rank " + std::to_string(rank) +
           " differs from the mesh of rank 0: its callbacks or parameters differ, or its host does not answer twice the same";
  });
}

void require_same_surfaces(Team& team, const CompositeRun& run) {
  std::string sums;
  std::vector<int> faces;
  const std::vector<std::vector<Vec2>> places = places_in_patches(team, run);
  for (std::size_t f = 0; f < run.patches.size(); ++f) {
    if (!run.has_patch(f) || !run.domains.domain[f]) continue;
    sums += checksum(answers(run, f, places[f]));
    faces.push_back(run.model.faces[f].ref);
  }
  const std::vector<std::string> all = team.exchange("surfaces", sums);
  for (std::size_t r = 1; r < all.size(); ++r) {
    if (all[r] == all[0]) continue;
    const std::size_t i = first_other(all[0], all[r]);
    refuse_other_face(i < faces.size() ? faces[i] : 0, r);
  }
}

void require_same_samples(Team& team, int face, const ControlSpace& space) {
  PacketWriter packet;
  space.put(packet);
  const std::vector<std::string> all = team.exchange("samples", checksum(packet.bytes()));
  for (std::size_t r = 1; r < all.size(); ++r)
    if (all[r] != all[0]) refuse_other_face(face, r);
}

}  // namespace carreau
