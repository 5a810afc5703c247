// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/division/mesh_part.h"

#include <algorithm>
#include <array>
#include <utility>

#include "support/error.h"
#include "support/ranks/triangle_packet.h"
#include "surface/remesh/base/cross_patch_mesh.h"
#include "surface/remesh/division/place_packet.h"

namespace carreau {

namespace {

using Triangle = EditableMesh::Triangle;

void sort_out(std::vector<std::int32_t>& numbers) {
  std::ranges::sort(numbers);
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

bool same_place(const SurfacePlace& a, const SurfacePlace& b) {
  return a.foot.triangle == b.foot.triangle && a.foot.uv == b.foot.uv && a.xyz == b.xyz;
}

}  // namespace

Division::Division(std::vector<std::vector<std::int32_t>> of_parts, std::size_t triangles)
    : parts(std::move(of_parts)), part(triangles, none) {
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (const std::int32_t t : parts[p]) part[t] = static_cast<std::int32_t>(p);
}

std::vector<std::int32_t> Division::meeting(const CrossPatchMesh& mesh) const {
  std::vector<std::int32_t> found;
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(mesh.vertices()); ++v) {
    std::int32_t first = none;
    for (const EditableMesh::Place p : mesh.mesh().fan(v)) {
      const std::int32_t here = part[p.triangle];
      if (here == none || here == first) continue;
      if (first != none) {
        found.push_back(v);
        break;
      }
      first = here;
    }
  }
  return found;
}

MeshPart::MeshPart(const CrossPatchMesh& whole, const Division& division, std::int32_t part) {
  const std::vector<std::int32_t>& inner = division.parts[part];
  std::vector<std::int32_t> own, outer, frozen_ones;
  for (const std::int32_t t : inner) own.insert(own.end(), whole.triangles()[t].begin(), whole.triangles()[t].end());
  sort_out(own);
  for (const std::int32_t v : own) {
    const std::size_t before = outer.size();
    for (const EditableMesh::Place p : whole.mesh().fan(v))
      if (division.part[p.triangle] != part) outer.push_back(p.triangle);
    if (outer.size() > before) frozen_ones.push_back(v);
  }
  sort_out(outer);
  vertex = own;
  for (const std::int32_t t : outer) vertex.insert(vertex.end(), whole.triangles()[t].begin(), whole.triangles()[t].end());
  sort_out(vertex);
  for (const std::int32_t v : vertex)
    frozen.push_back(!std::ranges::binary_search(own, v) || std::ranges::binary_search(frozen_ones, v) ? 1 : 0);
  const auto here = [&](const Triangle& t) { return Triangle{local(t[0]), local(t[1]), local(t[2])}; };
  for (const std::int32_t t : inner) triangles.push_back(here(whole.triangles()[t]));
  for (const std::int32_t t : outer) beyond.push_back(here(whole.triangles()[t]));
}

std::int32_t MeshPart::local(std::int32_t v) const {
  const auto at = std::ranges::lower_bound(vertex, v);
  return at != vertex.end() && *at == v ? static_cast<std::int32_t>(at - vertex.begin()) : -1;
}

std::vector<std::int32_t> MeshPart::local(std::span<const std::int32_t> vertices) const {
  std::vector<std::int32_t> here;
  for (std::size_t k = 0; k < vertex.size(); ++k)
    if (std::ranges::binary_search(vertices, vertex[k])) here.push_back(static_cast<std::int32_t>(k));
  return here;
}

EditedPart::EditedPart(const CrossPatchMesh& whole, const MeshPart& part, const CrossPatchMesh& edited, const RemeshingReport& of_edits)
    : report(of_edits) {
  const auto old = static_cast<std::int32_t>(part.vertex.size()), all = static_cast<std::int32_t>(edited.vertices());
  std::vector<std::int32_t> number = part.vertex;
  for (std::int32_t v = 0; v < old; ++v) {
    if (part.frozen[v] != 0 || !edited.is_alive(v) || same_place(edited.place(v), whole.place(part.vertex[v]))) continue;
    moved.push_back(part.vertex[v]);
    places.push_back(edited.place(v));
  }
  auto next = static_cast<std::int32_t>(whole.vertices());
  for (std::int32_t v = old; v < all; ++v) {
    number.push_back(edited.is_alive(v) ? next++ : -1);
    if (edited.is_alive(v)) places.push_back(edited.place(v));
  }
  const std::size_t first = part.triangles.size(), last = first + part.beyond.size();
  for (std::size_t t = 0; t < edited.triangles().size(); ++t) {
    const Triangle& c = edited.triangles()[t];
    if (c[0] < 0 || (t >= first && t < last)) continue;
    triangles.push_back({number[c[0]], number[c[1]], number[c[2]]});
  }
}

void EditedPart::put(PacketWriter& packet) const {
  put_triangles(packet, triangles);
  packet.put(moved);
  put_places(packet, places);
  packet.put(cost);
  for (const std::int64_t count : {report.collapses, report.splits, report.swaps, report.moves, std::int64_t{report.rounds}})
    packet.put(count);
}

EditedPart EditedPart::from(PacketReader& packet) {
  EditedPart part;
  part.triangles = triangles_of(packet);
  part.moved = packet.integers();
  part.places = places_of(packet);
  part.cost = packet.real();
  if (part.places.size() < part.moved.size()) throw Error("another process has sent bytes that are not a part of a mesh");
  part.report.collapses = packet.integer(), part.report.splits = packet.integer(), part.report.swaps = packet.integer();
  part.report.moves = packet.integer(), part.report.rounds = static_cast<int>(packet.integer());
  return part;
}

}  // namespace carreau
