// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/base/known_patches.h"

#include <algorithm>
#include <array>
#include <span>
#include <tuple>
#include <utility>

namespace carreau {

namespace {

template <typename T, typename Same>
bool all_same(const std::vector<T>& p, const std::vector<T>& q, const Same& same) {
  return std::equal(p.begin(), p.end(), q.begin(), q.end(), same);
}

bool same_edge(const PlaneEdge& p, const PlaneEdge& q) {
  const auto key = [](const PlaneEdge& e) {
    return std::tie(e.a, e.b, e.kind, e.curve, e.segment, e.min_fan, e.wide_fan);
  };
  return key(p) == key(q);
}

bool same_origin(const DomainVertexOrigin& p, const DomainVertexOrigin& q) {
  return std::tie(p.curve, p.node, p.corner, p.point) == std::tie(q.curve, q.node, q.corner, q.point);
}

bool same_source(const EdgeSizes::Source& p, const EdgeSizes::Source& q) {
  return p.a == q.a && p.b == q.b && p.h == q.h;
}

// The triangles of a patch from the assembled ones and the flattened ones with their numbers in the patch.
std::vector<std::array<std::int32_t, 3>> merged(const FaceMesh& face, std::span<const std::int32_t> flattened) {
  if (flattened.empty()) return face.triangles;
  std::vector<std::array<std::int32_t, 3>> all;
  all.reserve(face.triangles.size() + face.flattened.size());
  std::size_t flat = 0;
  for (const auto& t : face.triangles) {
    while (flat < flattened.size() && static_cast<std::size_t>(flattened[flat]) == all.size()) all.push_back(face.flattened[flat++]);
    all.push_back(t);
  }
  all.insert(all.end(), face.flattened.begin() + static_cast<std::ptrdiff_t>(flat), face.flattened.end());
  return all;
}

bool same_domain(const FaceDomain& p, const FaceDomain& q) {
  return p.plane.vertices == q.plane.vertices && p.size == q.size && p.physical == q.physical &&
         all_same(p.plane.edges, q.plane.edges, same_edge) && all_same(p.origin, q.origin, same_origin);
}

}  // namespace

void KnownPatches::keep(std::size_t face, const PatchInput& input, std::vector<EdgeSizes::Source> grow_from) {
  if (face >= known_.size()) return;
  if (known_[face] && known_[face]->mesh) room_ += known_[face]->triangles;
  known_[face].emplace();
  known_[face]->domain = *input.domain;
  known_[face]->curve_xyz = input.curve_xyz;
  known_[face]->grow_from = std::move(grow_from);
}

void KnownPatches::keep(std::size_t face, const FaceOutcome& outcome) {
  if (face >= known_.size() || !known_[face] || !outcome.patch) return;
  const std::size_t n = outcome.patch->plane.triangles.size();
  if (n > room_) {
    known_[face].reset();
    return;
  }
  room_ -= n;
  Known& known = *known_[face];
  const auto given = static_cast<std::ptrdiff_t>(std::min(known.domain.plane.vertices.size(), outcome.patch->xyz.size()));
  known.mesh.emplace();
  known.mesh->xyz.assign(outcome.patch->xyz.begin(), outcome.patch->xyz.begin() + given);
  known.mesh->size.assign(outcome.patch->size.begin(), outcome.patch->size.begin() + given);
  known.complete = false;
  known.vertices = outcome.patch->plane.vertices.size();
  known.triangles = n;
  known.remark = outcome.remark;
  known.layers = outcome.layers;
  known.turned = outcome.turned;
}

void KnownPatches::complete(const CompositeResult& result) {
  for (std::size_t f = 0; f < known_.size(); ++f) {
    if (!known_[f] || !known_[f]->mesh || known_[f]->complete) continue;
    Known& known = *known_[f];
    const FaceMesh& face = result.mesh.faces[f];
    if (face.uv.size() != known.vertices || face.triangles.size() + face.flattened.size() != known.triangles) {
      room_ += known.triangles;
      known_[f].reset();
      continue;
    }
    PatchMesh& mesh = *known.mesh;
    mesh.plane.vertices = face.uv;
    mesh.plane.triangles = merged(face, f < flattened_.size() ? flattened_[f] : std::vector<std::int32_t>{});
    std::size_t v = mesh.xyz.size();
    mesh.xyz.reserve(known.vertices), mesh.size.reserve(known.vertices);
    for (; v < known.vertices; ++v) {
      const auto whole = static_cast<std::size_t>(face.vertex[v]);
      mesh.xyz.push_back(result.mesh.vertices[whole]), mesh.size.push_back(result.vertex_size[whole]);
    }
    known.complete = true;
  }
}

std::optional<FaceOutcome> KnownPatches::find(std::size_t face, const PatchInput& input,
                                              const std::vector<EdgeSizes::Source>& grow_from) const {
  if (spaces_ == nullptr || face >= known_.size() || !known_[face] || !known_[face]->mesh || !known_[face]->complete) return {};
  if (face >= spaces_->size() || !(*spaces_)[face]) return {};
  const Known& known = *known_[face];
  if (known.curve_xyz != input.curve_xyz || !all_same(known.grow_from, grow_from, same_source) ||
      !same_domain(known.domain, *input.domain))
    return {};
  FaceOutcome outcome;
  outcome.patch = known.mesh;
  outcome.space = (*spaces_)[face];
  if (halved_) outcome.space->scale_lengths(0.5);
  outcome.remark = known.remark;
  outcome.layers = known.layers;
  outcome.turned = known.turned;
  return outcome;
}

}  // namespace carreau
