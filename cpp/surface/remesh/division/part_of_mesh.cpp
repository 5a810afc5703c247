// SPDX-License-Identifier: BSD-3-Clause
// Parts of a cross-patch mesh as separate meshes, and their results in the whole mesh.
#include <algorithm>
#include <utility>

#include "surface/remesh/base/cross_patch_mesh.h"
#include "surface/remesh/division/mesh_part.h"

namespace carreau {

CrossPatchMesh::CrossPatchMesh(const CrossPatchMesh& whole, const MeshPart& part)
    : PlacedVertices(whole.by_direction()),
      budget(whole.budget),
      frozen_(part.frozen),
      asked_(whole.asked_),
      tolerances_(whole.tolerances_),
      cosine_(whole.cosine_),
      guards_(whole.guards_),
      charts_(whole.charts_),
      cad_(whole.cad_) {
  std::vector<std::int32_t> corners;
  std::vector<std::array<std::int32_t, 2>> imposed;
  for (std::size_t k = 0; k < part.vertex.size(); ++k) {
    const std::int32_t v = part.vertex[k], here = static_cast<std::int32_t>(k);
    xyz_.push_back(whole.xyz_[v]), uv_.push_back(whole.uv_[v]), place_.push_back(whole.place_[v]), size_.push_back(whole.size_[v]);
    if (by_direction()) metric_.push_back(whole.metric_[v]);
    const bool kept = !whole.is_free(v) || frozen_[k] != 0;
    several_.push_back(kept ? static_cast<std::int32_t>(kept_places_.size()) : -1);
    const std::span<const SurfacePlace> places = whole.places(v);
    if (kept) kept_places_.emplace_back(places.begin(), places.end());
    if (frozen_[k] != 0 || whole.mesh_->is_corner(v)) corners.push_back(here);
    for (const std::int32_t w : whole.mesh_->imposed_around(v))
      if (const std::int32_t end = v < w ? part.local(w) : -1; end >= 0) imposed.push_back({here, end});
  }
  triangles_ = part.triangles;
  triangles_.insert(triangles_.end(), part.beyond.begin(), part.beyond.end());
  for (const auto& t : part.beyond)
    for (int i = 0; i < 3; ++i) imposed.push_back({t[i], t[(i + 1) % 3]});
  mixed_.assign(triangles_.size(), 1);
  mesh_.emplace(std::vector<EditableMesh::Face>{{&uv_, &triangles_, nullptr, &mixed_}}, xyz_, imposed, corners);
}

bool CrossPatchMesh::joins_frozen(std::int32_t gone, std::int32_t kept) const {
  if (!is_frozen(kept)) return false;
  const std::vector<std::int32_t> known = mesh_->ring(kept), around = mesh_->ring(gone);
  return std::ranges::any_of(around, [&](std::int32_t w) { return w != kept && is_frozen(w) && !std::ranges::binary_search(known, w); });
}

void CrossPatchMesh::take(const Division& division, std::vector<EditedPart>&& edited) {
  std::vector<std::array<std::int32_t, 2>> imposed;
  std::vector<std::int32_t> corners;
  const auto old = static_cast<std::int32_t>(vertices());
  for (std::int32_t v = 0; v < old; ++v) {
    if (mesh_->is_corner(v)) corners.push_back(v);
    for (const std::int32_t w : mesh_->imposed_around(v))
      if (v < w) imposed.push_back({v, w});
  }
  mesh_.reset();
  std::size_t t = 0;
  std::erase_if(triangles_, [&](const EditableMesh::Triangle& c) { return division.part[t++] != Division::none || c[0] < 0; });
  for (EditedPart& part : edited) take(std::exchange(part, {}), old);
  mixed_.assign(triangles_.size(), 1);
  mesh_.emplace(std::vector<EditableMesh::Face>{{&uv_, &triangles_, nullptr, &mixed_}}, xyz_, imposed, corners);
}

// New vertices are numbered from `old` on in each part.
void CrossPatchMesh::take(const EditedPart& part, std::int32_t old) {
  const std::int32_t shift = static_cast<std::int32_t>(vertices()) - old;
  for (std::size_t k = 0; k < part.places.size(); ++k) {
    const SurfacePlace& at = part.places[k];
    if (k < part.moved.size()) {
      put(part.moved[k], at, wanted_at(at));
      continue;
    }
    (void)try_vertex(at);
    xyz_.push_back(at.xyz), uv_.push_back(at.foot.uv);
  }
  for (EditableMesh::Triangle t : part.triangles) {
    for (std::int32_t& v : t)
      if (v >= old) v += shift;
    triangles_.push_back(t);
  }
}

}  // namespace carreau
