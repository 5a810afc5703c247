// SPDX-License-Identifier: BSD-3-Clause
// EditableMesh: edits and their reversal.
#include <algorithm>

#include "mesh/editable_mesh.h"

namespace carreau {

EditableMesh::Edit& EditableMesh::begin_edit() {
  return edits_.emplace_back(Edit{before_.size(), line_changes_.size()});
}

void EditableMesh::put(Place p, const Triangle& t) {
  for (const std::int32_t k : at(p))
    if (k >= 0) std::erase(star(global(p.face, k)).fan, p);
  (*faces_[p.face].triangles)[p.triangle] = t;
  for (const std::int32_t k : t)
    if (k >= 0) star(global(p.face, k)).fan.push_back(p);
}

void EditableMesh::replace(Place p, const Triangle& t, bool mixed) {
  before_.push_back({p, at(p), static_cast<char>(is_mixed(p))});
  put(p, t);
  if (auto* marks = faces_[p.face].mixed; marks != nullptr) (*marks)[p.triangle] = static_cast<char>(mixed);
}

void EditableMesh::add(std::int32_t face, const Triangle& t, bool mixed) {
  std::vector<Triangle>& all = *faces_[face].triangles;
  const Place p{face, static_cast<std::int32_t>(all.size())};
  all.push_back(t);
  if (auto* marks = faces_[face].mixed; marks != nullptr) marks->push_back(static_cast<char>(mixed));
  for (const std::int32_t v : t) star(global(face, v)).fan.push_back(p);
  ++edits_.back().new_triangles;
}

bool EditableMesh::swap(const Quad& q) {
  if (!can_swap(q)) return false;
  const bool mixed = q.mixed || is_mixed({q.face, q.t}) || is_mixed({q.face, q.u});
  const auto [first, second] = swapped(q);
  begin_edit();
  replace({q.face, q.t}, first, mixed);
  replace({q.face, q.u}, second, mixed);
  return true;
}

EditableMesh::Vertex EditableMesh::split(const Quad& q, const Vec2& uv, const Vec3& xyz, Split keeps) {
  const Face& face = faces_[q.face];
  const auto m = static_cast<std::int32_t>(face.uv->size());
  Edit& edit = begin_edit();
  edit.new_vertex = true;
  edit.vertex = {q.face, m};
  face.uv->push_back(uv);
  if (face.vertex != nullptr) face.vertex->push_back(static_cast<std::int32_t>(xyz_->size()));
  xyz_->push_back(xyz);
  if (mesh_ != nullptr) mesh_->vertex_ref.push_back(0);
  kept_.push_back(Kept::no);
  rank_.push_back(static_cast<std::int32_t>(stars_.size()));
  stars_.emplace_back();
  Triangle u{m, q.a, q.d}, beside{q.b, m, q.d};
  if (keeps == Split::at_start) std::swap(u, beside);
  const bool t_mixed = is_mixed({q.face, q.t}), u_mixed = is_mixed({q.face, q.u});
  replace({q.face, q.t}, {q.a, m, q.c}, t_mixed);
  replace({q.face, q.u}, u, u_mixed);
  add(q.face, {m, q.b, q.c}, t_mixed);
  add(q.face, beside, u_mixed);
  return {q.face, m};
}

void EditableMesh::move(Vertex v, const Vec2& uv, const Vec3& xyz) {
  Edit& edit = begin_edit();
  edit.moved = true;
  edit.vertex = v;
  edit.uv = std::exchange((*faces_[v.face].uv)[v.local], uv);
  edit.xyz = std::exchange((*xyz_)[global(v)], xyz);
}

void EditableMesh::change_line(std::int32_t v, std::int32_t w, bool added) {
  line_changes_.push_back({v, w, added});
  added ? impose(v, w) : release(v, w);
}

bool EditableMesh::undo(std::size_t edits) {
  const bool any = edits_.size() > edits;
  while (edits_.size() > edits) undo_last();
  return any;
}

// Triangles come back in the order in which they were changed, so that fans do not depend on how an edit was undone.
void EditableMesh::undo_last() {
  const Edit edit = edits_.back();
  edits_.pop_back();
  for (std::size_t k = edit.first_before; k < before_.size(); ++k) {
    const Before& b = before_[k];
    put(b.place, b.triangle);
    if (auto* marks = faces_[b.place.face].mixed; marks != nullptr) (*marks)[b.place.triangle] = b.mixed;
  }
  before_.resize(edit.first_before);
  while (line_changes_.size() > edit.first_line_change) {
    const LineChange c = line_changes_.back();
    line_changes_.pop_back();
    c.added ? release(c.v, c.w) : impose(c.v, c.w);
  }
  const Face& face = faces_[edit.vertex.face];
  for (int k = 0; k < edit.new_triangles; ++k) {
    const Place p{edit.vertex.face, static_cast<std::int32_t>(face.triangles->size()) - 1};
    for (const std::int32_t v : at(p)) std::erase(star(global(p.face, v)).fan, p);
    face.triangles->pop_back();
    if (face.mixed != nullptr) face.mixed->pop_back();
  }
  if (edit.moved) {
    (*xyz_)[global(edit.vertex)] = edit.xyz;
    (*face.uv)[edit.vertex.local] = edit.uv;
  }
  if (!edit.new_vertex) return;
  face.uv->pop_back();
  if (face.vertex != nullptr) face.vertex->pop_back();
  xyz_->pop_back();
  if (mesh_ != nullptr) mesh_->vertex_ref.pop_back();
  kept_.pop_back(), rank_.pop_back(), stars_.pop_back();
}

}  // namespace carreau
