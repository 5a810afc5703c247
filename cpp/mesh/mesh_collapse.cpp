// SPDX-License-Identifier: BSD-3-Clause
// EditableMesh: vertices that become one with a neighbour.
#include <algorithm>

#include "mesh/editable_mesh.h"

namespace carreau {

namespace {

// Beyond an edge that does not have two triangles lies this vertex: so borders are links like others.
constexpr std::int32_t outside = -1;

using Edge = std::array<std::int32_t, 2>;

Edge ordered(std::int32_t v, std::int32_t w) { return {std::min(v, w), std::max(v, w)}; }

/// The neighbourhood of a vertex.
struct Link {
  std::vector<std::int32_t> vertices;
  std::vector<Edge> edges;

  void add(std::int32_t v, std::int32_t w) {
    vertices.push_back(v), vertices.push_back(w);
    edges.push_back(ordered(v, w));
  }
  // A vertex is on two triangles, or on a border.
  void close() {
    std::ranges::sort(vertices);
    std::size_t left = 0;
    for (std::size_t k = 0, n = 0; k < vertices.size(); k += n) {
      for (n = 1; k + n < vertices.size() && vertices[k + n] == vertices[k];) ++n;
      if (n != 2) edges.push_back(ordered(outside, vertices[k]));
      vertices[left++] = vertices[k];
    }
    vertices.resize(left);
    if (std::ranges::any_of(edges, [](const Edge& e) { return e[0] == outside; }))
      vertices.insert(vertices.begin(), outside);
    std::ranges::sort(edges);
  }
};

template <typename T>
std::vector<T> common(const std::vector<T>& p, const std::vector<T>& q) {
  std::vector<T> both;
  std::ranges::set_intersection(p, q, std::back_inserter(both));
  return both;
}

}  // namespace

int EditableMesh::triangles_on(std::int32_t v, std::int32_t w) const {
  return static_cast<int>(std::ranges::count_if(fan(v), [&](Place p) {
    return std::ranges::any_of(at(p), [&](std::int32_t k) { return global(p.face, k) == w; });
  }));
}

// The link of the edge must equal the intersection of the links of its ends.
bool EditableMesh::keeps_topology(std::int32_t gone, std::int32_t kept) const {
  const auto link_of = [this](std::int32_t v) {
    Link link;
    link.vertices.reserve(2 * fan(v).size() + 1), link.edges.reserve(fan(v).size() + 2);
    for (const Place p : fan(v)) {
      const int i = rank_in(p, v);
      link.add(global(p.face, at(p)[(i + 1) % 3]), global(p.face, at(p)[(i + 2) % 3]));
    }
    link.close();
    return link;
  };
  const Link p = link_of(gone), q = link_of(kept);
  std::vector<std::int32_t> of_edge;
  for (const Place place : fan(gone)) {
    const Triangle& t = at(place);
    const Triangle v{global(place.face, t[0]), global(place.face, t[1]), global(place.face, t[2])};
    if (std::ranges::count(v, kept) != 0)
      of_edge.push_back(*std::ranges::find_if(v, [&](std::int32_t k) { return k != gone && k != kept; }));
  }
  if (of_edge.empty()) return false;
  if (of_edge.size() != 2) of_edge.push_back(outside);
  std::ranges::sort(of_edge);
  return common(p.vertices, q.vertices) == of_edge && common(p.edges, q.edges).empty();
}

bool EditableMesh::keeps_lines(std::int32_t gone, std::int32_t kept) const {
  if (kept_[gone] == Kept::no) return true;
  const std::vector<std::int32_t>& ends = star(gone).imposed;
  if (kept_[gone] == Kept::always || ends.size() != 2 || !is_imposed(gone, kept)) return false;
  const std::int32_t next = ends[0] == kept ? ends[1] : ends[0];
  return is_known(next) && triangles_on(kept, next) == 0;
}

EditableMesh::Replacements EditableMesh::replacements(std::int32_t gone, std::int32_t kept) const {
  Replacements found;
  for (const Place p : fan(gone)) {
    const Triangle& t = at(p);
    const auto own = std::ranges::find_if(t, [&](std::int32_t k) { return global(p.face, k) == gone; });
    const auto other = std::ranges::find_if(t, [&](std::int32_t k) { return global(p.face, k) == kept; });
    if (other != t.end()) found.push_back({{p.face, *own}, *other});
  }
  return found;
}

std::optional<std::vector<EditableMesh::Replaced>> EditableMesh::collapsed(std::int32_t gone, std::int32_t kept) const {
  const Replacements to = replacements(gone, kept);
  std::vector<Replaced> all;
  for (const Place p : fan(gone)) {
    Triangle t = at(p);
    if (std::ranges::any_of(t, [&](std::int32_t k) { return global(p.face, k) == kept; })) {
      all.push_back({p, {-1, -1, -1}, false});
      continue;
    }
    std::int32_t& corner = t[rank_in(p, gone)];
    auto it = std::ranges::find(to, Vertex{p.face, corner}, &Replacements::value_type::first);
    bool mixed = is_mixed(p);
    if (it == to.end() && faces_[p.face].mixed != nullptr) {
      it = std::ranges::find_if(to, [&](const auto& r) { return r.first.face == p.face; });
      mixed = true;
    }
    if (it == to.end()) return {};
    corner = it->second;
    if (!is_sound(p.face, t, mixed, mixed ? normal(p) : Vec3{0, 0, 0})) return {};
    all.push_back({p, t, mixed});
  }
  return all;
}

bool EditableMesh::can_collapse(std::int32_t gone, std::int32_t kept) const {
  return what_collapses(gone, kept).has_value();
}

std::optional<std::vector<EditableMesh::Replaced>> EditableMesh::what_collapses(std::int32_t gone,
                                                                                std::int32_t kept) const {
  if (gone == kept || !is_known(gone) || !is_known(kept)) return {};
  const bool all_known = std::ranges::all_of(fan(gone), [this](Place p) {
    return std::ranges::all_of(at(p), [&](std::int32_t k) { return is_known(global(p.face, k)); });
  });
  if (!all_known || !keeps_lines(gone, kept) || !keeps_topology(gone, kept)) return {};
  return collapsed(gone, kept);
}

bool EditableMesh::collapse(std::int32_t gone, std::int32_t kept) {
  const std::optional<std::vector<Replaced>> all = what_collapses(gone, kept);
  if (!all) return false;
  begin_edit().gone = gone;
  for (const Replaced& r : *all) replace(r.place, r.triangle, r.mixed);
  for (const std::int32_t end : std::vector(star(gone).imposed)) {
    change_line(gone, end, false);
    if (end != kept) change_line(kept, end, true);
  }
  return true;
}

std::vector<std::int32_t> EditableMesh::compact() {
  std::vector<std::int32_t> number(xyz_->size(), 0);
  for (const Edit& edit : edits_)
    if (edit.gone >= 0) number[edit.gone] = -1;
  std::int32_t left = 0;
  for (std::int32_t& n : number)
    if (n >= 0) n = left++;
  for (std::size_t f = 0; f < faces_.size(); ++f) compact_face(static_cast<std::int32_t>(f), number);
  const auto drop = [&](auto& list) {
    for (std::size_t v = 0; v < number.size(); ++v)
      if (number[v] >= 0) list[number[v]] = list[v];
    list.resize(left);
  };
  drop(*xyz_);
  if (mesh_ == nullptr) return number;
  drop(mesh_->vertex_ref);
  for (CurveMesh& curve : mesh_->curves) {
    for (std::int32_t& v : curve.vertices) v = number[v];
    std::erase(curve.vertices, -1);
  }
  return number;
}

void EditableMesh::compact_face(std::int32_t f, const std::vector<std::int32_t>& number) {
  const Face& face = faces_[f];
  std::vector<std::int32_t> local(face.uv->size(), -1);
  std::int32_t left = 0;
  for (std::size_t v = 0; v < local.size(); ++v) {
    const std::int32_t n = number[global(f, static_cast<std::int32_t>(v))];
    if (n < 0) continue;
    (*face.uv)[left] = (*face.uv)[v];
    if (face.vertex != nullptr) (*face.vertex)[left] = n;
    local[v] = left++;
  }
  face.uv->resize(left);
  if (face.vertex != nullptr) face.vertex->resize(left);
  std::size_t kept = 0;
  for (std::size_t t = 0; t < face.triangles->size(); ++t) {
    const Triangle c = (*face.triangles)[t];
    if (c[0] < 0) continue;
    if (face.mixed != nullptr) (*face.mixed)[kept] = (*face.mixed)[t];
    (*face.triangles)[kept++] = {local[c[0]], local[c[1]], local[c[2]]};
  }
  face.triangles->resize(kept);
  if (face.mixed != nullptr) face.mixed->resize(kept);
  if (mesh_ == nullptr) return;
  for (Triangle& t : mesh_->faces[f].flattened) t = {local[t[0]], local[t[1]], local[t[2]]};
}

}  // namespace carreau
