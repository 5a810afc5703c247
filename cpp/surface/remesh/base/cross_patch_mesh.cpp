// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/base/cross_patch_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/quality.h"
#include "support/infinity.h"
#include "surface/remesh/base/thresholds.h"

namespace carreau {

using namespace thresholds::remesh;

namespace {

std::vector<EditableMesh::Triangle> triangles_of(const Charts& charts) {
  std::vector<EditableMesh::Triangle> triangles;
  for (const Charts::Triangle& t : charts.triangles()) {
    const auto& [a, b, c] = t.vertex;
    triangles.push_back(t.turned ? EditableMesh::Triangle{a, c, b} : EditableMesh::Triangle{a, b, c});
  }
  return triangles;
}

}  // namespace

CrossPatchMesh::CrossPatchMesh(const SurfaceMesh& mesh, const VertexJets& jets, std::span<const double> size,
                   std::span<const MeshEdge> sharp, std::span<const std::int32_t> corners,
                   const SurfaceTolerances& tolerances, const Charts& charts, Cad& cad)
    : CrossPatchMesh(mesh, jets, size, sharp, corners, tolerances, charts, cad, {}, triangles_of(charts)) {}

CrossPatchMesh::CrossPatchMesh(const SurfaceMesh& mesh, const VertexJets& jets, std::span<const double> size,
                   std::span<const MeshEdge> sharp, std::span<const std::int32_t> corners,
                   const SurfaceTolerances& tolerances, const Charts& charts, Cad& cad,
                   std::span<const SurfacePlace> added, std::vector<EditableMesh::Triangle> triangles)
    : PlacedVertices(charts.by_direction()),
      xyz_(mesh.vertices),
      triangles_(std::move(triangles)),
      mixed_(triangles_.size(), 1),
      asked_(tolerances),
      tolerances_(tolerances),
      cosine_(std::cos(tolerances.angle_deg * std::numbers::pi / 180)),
      charts_(charts),
      cad_(cad) {
  size_.assign(size.begin(), size.end());
  several_.assign(xyz_.size(), -1);
  std::int32_t kept = 0;
  const auto keep = [&](std::int32_t v) {
    if (several_[v] < 0) several_[v] = kept++;
  };
  for (const MeshEdge& e : sharp) keep(e[0]), keep(e[1]);
  for (const std::int32_t v : corners) keep(v);
  kept_places_.resize(kept);
  place_vertices(mesh, jets);
  if (by_direction()) place_metrics();
  update_guards();
  for (const SurfacePlace& p : added) {
    (void)try_vertex(p);
    xyz_.push_back(p.xyz), uv_.push_back(p.foot.uv);
  }
  mesh_.emplace(std::vector<EditableMesh::Face>{{&uv_, &triangles_, nullptr, &mixed_}}, xyz_, sharp, corners);
}

void CrossPatchMesh::update_guards() {
  for (std::size_t t = 0; t < charts_.triangles().size() && !guards_; ++t)
    guards_ = charts_.is_guarded({static_cast<std::int32_t>(t), {}});
}

void CrossPatchMesh::place_vertices(const SurfaceMesh& mesh, const VertexJets& jets) {
  place_.resize(xyz_.size());
  for (std::size_t v = 0; v < xyz_.size(); ++v) place_[v].xyz = xyz_[v];
  const auto& triangles = charts_.triangles();
  std::vector<std::vector<char>> met(mesh.faces.size());
  for (std::size_t f = 0; f < met.size(); ++f) met[f].resize(mesh.faces[f].uv.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const std::int32_t v = triangles[t].vertex[i], local = triangles[t].local[i];
      // Sharp edges inside one chart have two sides.
      if (several_[v] < 0 && met[triangles[t].face][local] != 0) continue;
      met[triangles[t].face][local] = 1;
      const Foot foot{static_cast<std::int32_t>(t), charts_.uv(static_cast<std::int32_t>(t), i)};
      SurfacePlace place = charts_.place(foot, jets[triangles[t].face][local]);
      place.xyz = xyz_[v];
      if (place_[v].foot.triangle < 0 || (!place_[v].regular && place.regular)) place_[v] = place;
      if (several_[v] < 0) continue;
      auto& known = kept_places_[several_[v]];
      const auto same = [&](const SurfacePlace& p) {
        return charts_.face(p.foot) == triangles[t].face && p.foot.uv == foot.uv && dot(p.normal, place.normal) > 0;
      };
      if (!std::ranges::any_of(known, same)) known.push_back(place);
    }
  uv_.reserve(place_.size());
  for (const SurfacePlace& p : place_) uv_.push_back(p.foot.uv);
}

void CrossPatchMesh::place_metrics() {
  metric_.reserve(place_.size());
  for (std::size_t v = 0; v < place_.size(); ++v) {
    const auto here = static_cast<std::int32_t>(v);
    metric_.push_back(place_[v].foot.triangle < 0 ? isotropic_metric3(size_[v]) : wanted_at(places(here)).metric);
  }
}

void CrossPatchMesh::update_sizes() {
  for (std::size_t v = 0; v < place_.size(); ++v) {
    const auto here = static_cast<std::int32_t>(v);
    if (place_[v].foot.triangle < 0 || !is_alive(here)) continue;
    const WantedSize wanted = wanted_at(places(here));
    size_[v] = wanted.h;
    if (by_direction()) metric_[v] = wanted.metric;
  }
}

// If the surface bends more a coarse mesh is finer, so that features of the prescribed size stay.
void CrossPatchMesh::tighten(double factor) {
  tolerances_.share_of_size = asked_.share_of_size / factor;
  tolerances_.angle_deg = asked_.angle_deg / std::sqrt(factor);
  cosine_ = std::cos(tolerances_.angle_deg * std::numbers::pi / 180);
}

double CrossPatchMesh::length(std::int32_t v, std::int32_t w) const {
  if (by_direction()) {
    const Vec3 way = position(w) - position(v);
    return length_between(carreau::length(metric_[v], way), carreau::length(metric_[w], way));
  }
  return length_between_sizes(norm(position(w) - position(v)), size_[v], size_[w]);
}

Metric2 CrossPatchMesh::gram_of(std::int32_t a, std::int32_t b, std::int32_t c) const {
  const Vec3 p = position(b) - position(a), q = position(c) - position(a);
  return (1. / 3) * (gram(metric_[a], p, q) + gram(metric_[b], p, q) + gram(metric_[c], p, q));
}

double CrossPatchMesh::double_area(const EditableMesh::Triangle& t) const {
  if (by_direction()) return std::sqrt(std::max(0.0, determinant(gram_of(t[0], t[1], t[2]))));
  const double h = (size_[t[0]] + size_[t[1]] + size_[t[2]]) / 3;
  return norm(mesh_->normal(0, t)) / (h * h);
}

void CrossPatchMesh::judge_shape(std::int32_t a, std::int32_t b, std::int32_t c, TriangleShapes& shapes) const {
  shapes.add(by_direction() ? quality_q2(gram_of(a, b, c)) : quality_q2(place_[a].xyz, place_[b].xyz, place_[c].xyz));
}

void CrossPatchMesh::judge_agreement(std::int32_t a, std::int32_t b, std::int32_t c, TriangleShapes& shapes) const {
  const std::array<std::int32_t, 3> v{a, b, c};
  const std::array<const Vec3*, 3> p{&place_[a].xyz, &place_[b].xyz, &place_[c].xyz};
  const Vec3 n = cross(*p[1] - *p[0], *p[2] - *p[0]);
  std::array<const Vec3*, 3> normal;
  bool regular = false;
  double least = infinity;  // cosine, times the area
  for (int i = 0; i < 3; ++i) {
    normal[i] = &place_towards(v[i], n).normal;
    if (dot(*normal[i], *normal[i]) == 0) continue;  // singular
    regular = true;
    least = std::min(least, dot(*normal[i], n));
  }
  const double area = norm(n);
  double share = regular ? std::max(0.0, (1 - (area > 0 ? least / area : -1)) / (1 - cosine_)) : 0;
  const bool by_length = by_direction() && !(tolerances_.deviation > 0);
  double most = tolerances_.deviation_at((size_[a] + size_[b] + size_[c]) / 3);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const Vec3 d = *p[j] - *p[i];
    const double offset = (std::abs(dot(d, *normal[i])) + std::abs(dot(d, *normal[j]))) / 8;
    if (by_length) most = tolerances_.share_of_size * norm(d) / length(v[i], v[j]);
    share = std::max(share, offset * offset / (most * most));
  }
  const bool guarded = guards_ && std::ranges::any_of(v, [&](std::int32_t w) { return charts_.is_guarded(place_[w].foot); });
  if (guarded) share = budget.is_limited() ? infinity : guarded_factor * share;  // infinity: no edits there
  shapes.share = std::max(shapes.share, share);
}

TriangleShapes CrossPatchMesh::judge_fan(std::int32_t v, Judge how) const {
  TriangleShapes shapes;
  for (const Place p : mesh_->fan(v)) {
    const auto& [a, b, c] = mesh_->at(p);
    (this->*how)(a, b, c, shapes);
  }
  return shapes;
}

std::optional<SurfacePlace> CrossPatchMesh::near(std::int32_t v, const Vec3& normal, const Vec3& target) {
  return charts_.towards(cad_, place_towards(v, normal), target);
}

std::int32_t CrossPatchMesh::split(const Quad& q, const SurfacePlace& at) {
  (void)try_vertex(at);
  return mesh_->split(q, at.foot.uv, at.xyz).local;
}

bool CrossPatchMesh::undo(const State& state) {
  const bool any = this->state() != state;
  for (; moved_.size() > state[1]; moved_.pop_back()) {
    Moved& last = moved_.back();
    set_place(last.vertex, last.place, last.wanted);
    if (!is_free(last.vertex)) kept_places_[several_[last.vertex]] = std::move(last.kept);
  }
  mesh_->undo(state[0]);
  while (place_.size() > xyz_.size()) forget_vertex();
  return any;
}

void CrossPatchMesh::put_kept(std::int32_t v, std::span<const SurfacePlace> at, const WantedSize& wanted) {
  put(v, at.front(), wanted);
  kept_places_[several_[v]].assign(at.begin(), at.end());
}

void CrossPatchMesh::put(std::int32_t v, const SurfacePlace& at, const WantedSize& wanted) {
  if (trials_ > 0) moved_.push_back({v, place_[v], is_free(v) ? std::vector<SurfacePlace>{} : kept_places_[several_[v]], this->wanted(v)});
  set_place(v, at, wanted);
}

void CrossPatchMesh::set_place(std::int32_t v, const SurfacePlace& at, const WantedSize& wanted) {
  move(v, at, wanted);
  xyz_[v] = at.xyz;
  uv_[v] = at.foot.uv;
}

}  // namespace carreau
