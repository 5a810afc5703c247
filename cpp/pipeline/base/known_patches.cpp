// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/base/known_patches.h"

#include <algorithm>
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

bool same_domain(const FaceDomain& p, const FaceDomain& q) {
  return p.plane.vertices == q.plane.vertices && p.size == q.size && p.physical == q.physical &&
         all_same(p.plane.edges, q.plane.edges, same_edge) && all_same(p.origin, q.origin, same_origin);
}

}  // namespace

void KnownPatches::keep(std::size_t face, const PatchInput& input, std::vector<EdgeSizes::Source> grow_from) {
  if (face >= known_.size()) return;
  if (known_[face] && known_[face]->mesh) room_ += known_[face]->mesh->plane.triangles.size();
  known_[face] = Known{*input.domain, input.curve_xyz, std::move(grow_from), {}, {}, {}};
}

void KnownPatches::keep(std::size_t face, const FaceOutcome& outcome) {
  if (face >= known_.size() || !known_[face] || !outcome.patch) return;
  const std::size_t n = outcome.patch->plane.triangles.size();
  if (n > room_) {
    known_[face].reset();
    return;
  }
  room_ -= n;
  known_[face]->mesh = outcome.patch;
  known_[face]->remark = outcome.remark;
  known_[face]->layers = outcome.layers;
}

std::optional<FaceOutcome> KnownPatches::find(std::size_t face, const PatchInput& input,
                                              const std::vector<EdgeSizes::Source>& grow_from) const {
  if (spaces_ == nullptr || face >= known_.size() || !known_[face] || !known_[face]->mesh) return {};
  if (face >= spaces_->size() || !(*spaces_)[face]) return {};
  const Known& known = *known_[face];
  if (known.curve_xyz != input.curve_xyz || !all_same(known.grow_from, grow_from, same_source) ||
      !same_domain(known.domain, *input.domain))
    return {};
  FaceOutcome outcome;
  outcome.patch = known.mesh;
  outcome.space = (*spaces_)[face];
  outcome.remark = known.remark;
  outcome.layers = known.layers;
  return outcome;
}

}  // namespace carreau
