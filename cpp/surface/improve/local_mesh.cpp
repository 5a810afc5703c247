#include "surface/improve/local_mesh.h"

#include <algorithm>

#include "predicates/predicates.h"

namespace carreau {

namespace {

std::array<std::int32_t, 2> key(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

}  // namespace

LocalMesh::LocalMesh(SurfaceMesh& mesh, std::span<const std::int32_t> centres, int rings) : mesh_(mesh) {
  mark_curves();
  collect(centres, rings);
}

void LocalMesh::mark_curves() {
  fixed_.assign(mesh_.vertices.size(), 0);
  for (const CurveMesh& curve : mesh_.curves)
    for (std::size_t k = 0; k < curve.vertices.size(); ++k) {
      fixed_[curve.vertices[k]] = 1;
      if (k > 0) imposed_.push_back(key(curve.vertices[k - 1], curve.vertices[k]));
    }
  std::sort(imposed_.begin(), imposed_.end());
  for (std::size_t v = 0; v < fixed_.size(); ++v)
    if (mesh_.vertex_ref[v] != 0) fixed_[v] = 1;
  for (const FaceMesh& face : mesh_.faces)
    for (const Triangle& t : face.flattened)
      for (const std::int32_t v : t) fixed_[face.vertex[v]] = 1;
}

template <typename Use>
void LocalMesh::for_triangles(const Use& use) const {
  for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
    const FaceMesh& face = mesh_.faces[f];
    for (std::size_t t = 0; t < face.triangles.size(); ++t)
      use(Place{static_cast<std::int32_t>(f), static_cast<std::int32_t>(t)}, face.vertex, face.triangles[t]);
  }
}

void LocalMesh::collect(std::span<const std::int32_t> centres, int rings) {
  std::vector<int> ring(mesh_.vertices.size(), -1);  // how far a vertex is from a centre
  for (const std::int32_t v : centres) ring[v] = 0;
  for (int k = 0; k < rings; ++k)
    for_triangles([&](Place, const std::vector<std::int32_t>& vertex, const Triangle& t) {
      const auto reached = [&](std::int32_t v) { return ring[vertex[v]] >= 0 && ring[vertex[v]] <= k; };
      if (!std::any_of(t.begin(), t.end(), reached)) return;
      for (const std::int32_t v : t)
        if (ring[vertex[v]] < 0) ring[vertex[v]] = k + 1;
    });
  rank_.assign(mesh_.vertices.size(), -1);
  std::int32_t known = 0;
  for (std::size_t v = 0; v < ring.size(); ++v)
    if (ring[v] >= 0) rank_[v] = known++;
  fans_.resize(known);
  for_triangles([&](Place p, const std::vector<std::int32_t>& vertex, const Triangle& t) {
    for (const std::int32_t v : t)
      if (is_known(vertex[v])) fan_of(vertex[v]).push_back(p);
  });
}

std::vector<std::int32_t> LocalMesh::ring(std::int32_t v) const {
  std::vector<std::int32_t> around;
  for (const Place p : fan(v))
    for (const std::int32_t k : at(p))
      if (global(p.face, k) != v) around.push_back(global(p.face, k));
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  return around;
}

std::optional<LocalMesh::Vertex> LocalMesh::inside(std::int32_t v) const {
  if (!is_known(v) || fixed_[v] != 0) return {};
  const std::vector<std::int32_t> around = ring(v);
  if (!std::all_of(around.begin(), around.end(), [this](std::int32_t w) { return is_known(w); })) return {};
  const Place p = fan(v).front();
  for (const std::int32_t k : at(p))
    if (global(p.face, k) == v) return Vertex{p.face, k};
  return {};
}

std::optional<LocalMesh::Quad> LocalMesh::quad(Place p, int side) const {
  const Triangle& t = at(p);
  const std::int32_t a = t[side], b = t[(side + 1) % 3], c = t[(side + 2) % 3];
  const std::int32_t v = global(p.face, a), w = global(p.face, b);
  if (!is_known(v) || !is_known(w) || !is_known(global(p.face, c)) ||
      std::binary_search(imposed_.begin(), imposed_.end(), key(v, w)))
    return {};
  for (const Place other : fan(v)) {
    if (other.face != p.face || other == p) continue;
    const Triangle& u = at(other);
    for (int j = 0; j < 3; ++j) {
      const std::int32_t d = u[(j + 2) % 3];
      if (u[j] == b && u[(j + 1) % 3] == a && is_known(global(p.face, d)))
        return Quad{p.face, p.triangle, other.triangle, a, b, c, d, t, u};
    }
  }
  return {};
}

std::array<std::int32_t, 4> LocalMesh::corners(const Quad& q) const {
  return {global(q.face, q.a), global(q.face, q.b), global(q.face, q.c), global(q.face, q.d)};
}

Vec3 LocalMesh::normal(Place p) const {
  const Triangle& t = at(p);
  const Vec3 a = position(p.face, t[0]);
  return cross(position(p.face, t[1]) - a, position(p.face, t[2]) - a);
}

Vec3 LocalMesh::mean_normal(std::span<const Place> places) const {
  Vec3 sum{};
  for (const Place p : places) sum = sum + normal(p);
  const double l = norm(sum);
  return l > 0 ? (1 / l) * sum : Vec3{};
}

bool LocalMesh::is_positive(std::int32_t face, const Triangle& t) const {
  const std::vector<Vec2>& uv = mesh_.faces[face].uv;
  return orientation(uv[t[0]], uv[t[1]], uv[t[2]]) > 0;
}

bool LocalMesh::are_positive(std::span<const Place> places) const {
  return std::all_of(places.begin(), places.end(), [this](Place p) { return is_positive(p.face, at(p)); });
}

void LocalMesh::put(Place p, const Triangle& t) {
  for (const std::int32_t k : at(p)) std::erase(fan_of(global(p.face, k)), p);
  mesh_.faces[p.face].triangles[p.triangle] = t;
  for (const std::int32_t k : t) fan_of(global(p.face, k)).push_back(p);
}

void LocalMesh::restore(const Quad& q) {
  put({q.face, q.t}, q.first);
  put({q.face, q.u}, q.second);
}

bool LocalMesh::swap(const Quad& q) {
  const Triangle first{q.a, q.d, q.c}, second{q.d, q.b, q.c};
  const std::int32_t c = global(q.face, q.c), d = global(q.face, q.d);
  const std::vector<std::int32_t> around = ring(c);
  if (c == d || std::binary_search(around.begin(), around.end(), d) || !is_positive(q.face, first) ||
      !is_positive(q.face, second))
    return false;
  put({q.face, q.t}, first);
  put({q.face, q.u}, second);
  return true;
}

std::optional<LocalMesh::Vertex> LocalMesh::divide(const Quad& q) {
  FaceMesh& face = mesh_.faces[q.face];
  const auto m = static_cast<std::int32_t>(face.uv.size());
  const std::array<Triangle, 4> parts{{{q.a, m, q.c}, {m, q.a, q.d}, {m, q.b, q.c}, {q.b, m, q.d}}};
  face.uv.push_back(0.5 * (face.uv[q.a] + face.uv[q.b]));
  if (!std::all_of(parts.begin(), parts.end(), [&](const Triangle& t) { return is_positive(q.face, t); })) {
    face.uv.pop_back();
    return {};
  }
  face.vertex.push_back(static_cast<std::int32_t>(mesh_.vertices.size()));
  mesh_.vertices.emplace_back();
  mesh_.vertex_ref.push_back(0);
  fixed_.push_back(0);
  rank_.push_back(static_cast<std::int32_t>(fans_.size()));
  fans_.emplace_back();
  put({q.face, q.t}, parts[0]);
  put({q.face, q.u}, parts[1]);
  for (std::size_t k = 2; k < 4; ++k) {
    const Place p{q.face, static_cast<std::int32_t>(face.triangles.size())};
    face.triangles.push_back(parts[k]);
    for (const std::int32_t v : parts[k]) fan_of(global(q.face, v)).push_back(p);
  }
  return Vertex{q.face, m};
}

void LocalMesh::unite(const Quad& q) {
  FaceMesh& face = mesh_.faces[q.face];
  restore(q);
  for (int k = 0; k < 2; ++k) {
    const Place p{q.face, static_cast<std::int32_t>(face.triangles.size()) - 1};
    for (const std::int32_t v : face.triangles.back()) std::erase(fan_of(global(q.face, v)), p);
    face.triangles.pop_back();
  }
  face.uv.pop_back(), face.vertex.pop_back();
  mesh_.vertices.pop_back(), mesh_.vertex_ref.pop_back();
  fixed_.pop_back(), rank_.pop_back(), fans_.pop_back();
}

}  // namespace carreau
