// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/editable_mesh.h"

#include <algorithm>

#include "predicates/predicates.h"

namespace carreau {

EditableMesh::EditableMesh(SurfaceMesh& mesh, std::span<const std::int32_t> centres, int rings)
    : mesh_(&mesh), xyz_(&mesh.vertices) {
  for (FaceMesh& face : mesh.faces) faces_.push_back({&face.uv, &face.triangles, &face.vertex});
  know_around(centres, rings);
  mark_curves();
}

EditableMesh::EditableMesh(const PlaneDomain& domain, PlaneMesh& mesh, std::vector<Vec3>& xyz)
    : faces_{{&mesh.vertices, &mesh.triangles}}, xyz_(&xyz) {
  know_all();
  impose(domain);
}

EditableMesh::EditableMesh(const PlaneDomain& domain, PlaneMesh& mesh, std::vector<Vec3>& xyz,
                           std::span<const std::int32_t> triangles)
    : faces_{{&mesh.vertices, &mesh.triangles}}, xyz_(&xyz), rank_(xyz.size(), -1) {
  for (const std::int32_t t : triangles)
    for (const std::int32_t v : mesh.triangles[t]) {
      if (rank_[v] < 0) rank_[v] = static_cast<std::int32_t>(stars_.size()), stars_.emplace_back();
      star(v).fan.push_back({0, t});
    }
  impose(domain);
}

EditableMesh::EditableMesh(std::vector<Face> faces, std::vector<Vec3>& xyz,
                           std::span<const std::array<std::int32_t, 2>> imposed, std::span<const std::int32_t> corners)
    : faces_(std::move(faces)), xyz_(&xyz), kept_(xyz.size(), Kept::no) {
  know_all();
  for (const auto& [v, w] : imposed) {
    impose(v, w);
    kept_[v] = kept_[w] = Kept::on_line;
  }
  for (const std::int32_t v : corners) kept_[v] = Kept::always;
}

void EditableMesh::impose(const PlaneDomain& domain) {
  kept_.assign(xyz_->size(), Kept::no);
  std::fill_n(kept_.begin(), domain.vertices.size(), Kept::always);
  for (const PlaneEdge& e : domain.edges) impose(e.a, e.b);
}

void EditableMesh::impose(std::int32_t v, std::int32_t w) {
  for (const auto& [from, to] : {std::pair{v, w}, std::pair{w, v}})
    if (is_known(from) && std::ranges::count(star(from).imposed, to) == 0) star(from).imposed.push_back(to);
}

void EditableMesh::release(std::int32_t v, std::int32_t w) {
  std::erase(star(v).imposed, w);
  std::erase(star(w).imposed, v);
}

void EditableMesh::mark_curves() {
  kept_.assign(mesh_->vertices.size(), Kept::no);
  for (const CurveMesh& curve : mesh_->curves) {
    for (std::size_t k = 0; k < curve.vertices.size(); ++k) {
      kept_[curve.vertices[k]] = std::max(kept_[curve.vertices[k]], Kept::on_line);
      if (k > 0) impose(curve.vertices[k - 1], curve.vertices[k]);
    }
    if (!curve.vertices.empty()) kept_[curve.vertices.front()] = kept_[curve.vertices.back()] = Kept::always;
  }
  for (std::size_t v = 0; v < kept_.size(); ++v)
    if (mesh_->vertex_ref[v] != 0) kept_[v] = Kept::always;
  for (const FaceMesh& face : mesh_->faces)
    for (const Triangle& t : face.flattened)
      for (const std::int32_t v : t) kept_[face.vertex[v]] = Kept::always;
}

template <typename Use>
void EditableMesh::for_triangles(const Use& use) const {
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const auto face = static_cast<std::int32_t>(f);
    const std::vector<Triangle>& all = *faces_[f].triangles;
    for (std::size_t t = 0; t < all.size(); ++t)
      use(Place{face, static_cast<std::int32_t>(t)},
          Triangle{global(face, all[t][0]), global(face, all[t][1]), global(face, all[t][2])});
  }
}

void EditableMesh::know_around(std::span<const std::int32_t> centres, int rings) {
  std::vector<int> ring(xyz_->size(), -1);  // distance of a vertex to a centre, in rings
  for (const std::int32_t v : centres) ring[v] = 0;
  for (int k = 0; k < rings; ++k)
    for_triangles([&](Place, const Triangle& t) {
      const auto reached = [&](std::int32_t v) { return ring[v] >= 0 && ring[v] <= k; };
      if (!std::any_of(t.begin(), t.end(), reached)) return;
      for (const std::int32_t v : t)
        if (ring[v] < 0) ring[v] = k + 1;
    });
  rank_.assign(xyz_->size(), -1);
  std::int32_t known = 0;
  for (std::size_t v = 0; v < ring.size(); ++v)
    if (ring[v] >= 0) rank_[v] = known++;
  stars_.resize(known);
  for_triangles([&](Place p, const Triangle& t) {
    for (const std::int32_t v : t)
      if (is_known(v)) star(v).fan.push_back(p);
  });
}

void EditableMesh::know_all() {
  rank_.resize(xyz_->size());
  for (std::size_t v = 0; v < rank_.size(); ++v) rank_[v] = static_cast<std::int32_t>(v);
  stars_.resize(rank_.size());
  for_triangles([&](Place p, const Triangle& t) {
    for (const std::int32_t v : t) star(v).fan.push_back(p);
  });
}

std::vector<std::int32_t> EditableMesh::ring(std::int32_t v) const {
  std::vector<std::int32_t> around;
  for (const Place p : fan(v))
    for (const std::int32_t k : at(p))
      if (global(p.face, k) != v) around.push_back(global(p.face, k));
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  return around;
}

std::vector<std::int32_t> EditableMesh::with_ring(std::int32_t v) const {
  std::vector<std::int32_t> around = ring(v);
  around.push_back(v);
  return around;
}

int EditableMesh::rank_in(Place p, std::int32_t v) const {
  const Triangle& t = at(p);
  return global(p.face, t[0]) == v ? 0 : global(p.face, t[1]) == v ? 1 : 2;
}

std::optional<EditableMesh::Vertex> EditableMesh::inside(std::int32_t v) const {
  if (!is_known(v) || kept_[v] != Kept::no) return {};
  const std::vector<std::int32_t> around = ring(v);
  if (!std::all_of(around.begin(), around.end(), [this](std::int32_t w) { return is_known(w); })) return {};
  const Place p = fan(v).front();
  return Vertex{p.face, at(p)[rank_in(p, v)]};
}

bool EditableMesh::is_imposed(std::int32_t v, std::int32_t w) const {
  const std::vector<std::int32_t>& ends = star(v).imposed;
  return std::find(ends.begin(), ends.end(), w) != ends.end();
}

std::optional<EditableMesh::Quad> EditableMesh::quad(Place p, int side) const {
  const Triangle& t = at(p);
  const std::int32_t a = t[side], b = t[(side + 1) % 3], c = t[(side + 2) % 3];
  const std::int32_t v = global(p.face, a), w = global(p.face, b);
  if (!is_known(v) || !is_known(w) || !is_known(global(p.face, c)) || is_imposed(v, w)) return {};
  const bool over_borders = faces_[p.face].mixed != nullptr;
  for (const Place other : fan(v)) {
    if (other.face != p.face || other == p) continue;
    const Triangle& u = at(other);
    for (int j = 0; j < 3; ++j) {
      const std::int32_t from = u[j], to = u[(j + 1) % 3], d = u[(j + 2) % 3];
      const bool same = from == b && to == a;
      if (!same && !(over_borders && global(p.face, from) == w && global(p.face, to) == v)) continue;
      if (is_known(global(p.face, d))) return Quad{p.face, p.triangle, other.triangle, a, b, c, d, !same};
    }
  }
  return {};
}

std::optional<EditableMesh::Quad> EditableMesh::quad_between(Vertex a, std::int32_t b) const {
  for (const Place p : fan(global(a)))
    for (int i = 0; i < 3; ++i)
      if (p.face == a.face && at(p)[i] == a.local && at(p)[(i + 1) % 3] == b) return quad(p, i);
  return {};
}

std::array<std::int32_t, 4> EditableMesh::corners(const Quad& q) const {
  return {global(q.face, q.a), global(q.face, q.b), global(q.face, q.c), global(q.face, q.d)};
}

Vec3 EditableMesh::normal(std::int32_t face, const Triangle& t) const {
  const Vec3 a = position(face, t[0]);
  return cross(position(face, t[1]) - a, position(face, t[2]) - a);
}

Vec3 EditableMesh::mean_normal(std::span<const Place> places) const {
  Vec3 sum{0, 0, 0};
  for (const Place p : places) sum = sum + normal(p);
  const double l = norm(sum);
  return l > 0 ? (1 / l) * sum : Vec3{0, 0, 0};
}

bool EditableMesh::is_positive(std::int32_t face, const Triangle& t) const {
  const std::vector<Vec2>& uv = *faces_[face].uv;
  return orientation(uv[t[0]], uv[t[1]], uv[t[2]]) > 0;
}

bool EditableMesh::is_mixed(Place p) const {
  const std::vector<char>* mixed = faces_[p.face].mixed;
  return mixed != nullptr && (*mixed)[p.triangle] != 0;
}

bool EditableMesh::is_sound(std::int32_t face, const Triangle& t, bool mixed, const Vec3& replaced) const {
  return mixed ? dot(normal(face, t), replaced) > 0 : is_positive(face, t);
}

bool EditableMesh::can_swap(const Quad& q) const {
  const std::int32_t c = global(q.face, q.c), d = global(q.face, q.d);
  if (c == d || triangles_on(c, d) > 0) return false;
  const bool mixed = q.mixed || is_mixed({q.face, q.t}) || is_mixed({q.face, q.u});
  const Vec3 replaced = mixed ? mean_normal(q.places()) : Vec3{0, 0, 0};
  const auto [first, second] = swapped(q);
  return is_sound(q.face, first, mixed, replaced) && is_sound(q.face, second, mixed, replaced);
}

bool EditableMesh::can_split(const Quad& q, const Vec2& uv) const {
  const std::vector<Vec2>& at = *faces_[q.face].uv;
  const auto is_left = [&](std::int32_t from, std::int32_t to) { return orientation(at[from], uv, at[to]) > 0; };
  return !q.mixed && !is_mixed({q.face, q.t}) && !is_mixed({q.face, q.u}) && is_left(q.a, q.c) && is_left(q.c, q.b) &&
         is_left(q.b, q.d) && is_left(q.d, q.a);
}

bool EditableMesh::can_move(Vertex v, const Vec2& uv) const {
  const std::vector<Vec2>& all = *faces_[v.face].uv;
  const std::int32_t moved = v.local;
  return std::ranges::all_of(fan(global(v)), [&](Place p) {
    if (is_mixed(p)) return true;
    const auto corner = [&](int i) { return at(p)[i] == moved ? uv : all[at(p)[i]]; };
    return orientation(corner(0), corner(1), corner(2)) > 0;
  });
}

}  // namespace carreau
