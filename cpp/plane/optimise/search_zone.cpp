// SPDX-License-Identifier: BSD-3-Clause
#include "plane/optimise/search_zone.h"

#include <algorithm>

#include "plane/kernel/thresholds.h"

namespace carreau::plane {

SearchZone::SearchZone(PlaneWork& shared, const SampledNormals* normals) : work(shared), normals_(normals) {
  for (const Vertex& V : work.mesh.vertices) places.push_back(key_of_place(V.point()));
  known_shapes_.clear(), known_moves.clear(), known_swaps.clear(), known_normals_.clear();
}

void SearchZone::list_triangles(std::vector<std::int32_t>& vertices) {
  Triangulation& mesh = work.mesh;
  std::size_t done = 0;
  for (int ring = 0; ring < 2; ++ring) {
    const std::size_t end = vertices.size();
    for (; done < end; ++done) {
      if (vertices[done] >= work.fixed) movable.push_back(vertices[done]);
      for_each_around(mesh, vertices[done], [&](int s) {
        Triangle& S = mesh.triangles[s];
        if (S.mark != 0) return;
        S.mark = 1;
        triangles.push_back(s);
        for (const std::int32_t w : S.v)
          if (seen_[w] == 0) seen_[w] = 1, vertices.push_back(w);
      });
    }
  }
}

void SearchZone::collect(int t) {
  Triangulation& mesh = work.mesh;
  triangles.clear(), movable.clear(), as_they_were_.clear(), old_vertices_.clear();
  centre = {mesh.triangles[t].v[0], mesh.triangles[t].v[1], mesh.triangles[t].v[2]};
  seen_.resize(mesh.vertices.size(), 0);
  vertices_.assign(centre.begin(), centre.end());
  for (const std::int32_t v : vertices_) seen_[v] = 1;
  list_triangles(vertices_);
  for (const std::int32_t v : vertices_) old_vertices_.emplace_back(v, mesh.vertices[v]), seen_[v] = 0;
  for (const std::int32_t s : triangles) mesh.triangles[s].mark = 0;
  for (const std::int32_t s : triangles) as_they_were_.emplace_back(s, mesh.triangles[s]);
  for (const std::int32_t s : triangles)
    for (const HalfEdge n : mesh.triangles[s].n)
      if (n != no_edge) as_they_were_.emplace_back(n >> 2, mesh.triangles[n >> 2]);
  mesh_triangles_ = mesh.triangles.size(), mesh_vertices_ = mesh.vertices.size();
  own_triangles_ = triangles.size(), own_movable_ = movable.size();
}

void SearchZone::restore() {
  Triangulation& mesh = work.mesh;
  mesh.triangles.resize(mesh_triangles_);
  mesh.vertices.resize(mesh_vertices_);
  for (const auto& [t, T] : as_they_were_) mesh.triangles[t] = T;
  places.resize(mesh_vertices_);
  for (const auto& [v, V] : old_vertices_) mesh.vertices[v] = V, places[v] = key_of_place(V.point());
  triangles.resize(own_triangles_);
  movable.resize(own_movable_);
}

void SearchZone::add_edges(const Triangle& T, int t, ZoneCost& all) {
  const Triangulation& mesh = work.mesh;
  for (int i = 0; i < 3; ++i) {
    if (mesh.is_imposed(t, i)) continue;
    const std::int32_t a = T.v[next3[i]], b = T.v[prev3[i]];
    all.across += a < work.fixed && b < work.fixed ? 1 : 0;
    const double l2 = mesh.squared_length(a, b);
    all.shortest2 = std::min(all.shortest2, l2), all.longest2 = std::max(all.longest2, l2);
    if (normals_ == nullptr) continue;
    const Vec3 at_a = normal(a), turn = at_a - normal(b);
    const double turn2 = std::max(dot(turn, turn), min_turn2);
    all.turn2 = std::max(all.turn2, turn2), all.turns4 += turn2 * turn2 - min_turn2 * min_turn2;
  }
}

ZoneCost SearchZone::cost_of_shapes(double enough) {
  ZoneCost all;
  int count = 0;
  const auto counts = [](const Triangle& T) { return T.v[0] >= 0 && T.done != Done::frozen; };
  for (const std::int32_t t : triangles)
    if (counts(work.mesh.triangles[t])) ++count;
  const double most = enough * count;
  for (const std::int32_t t : triangles) {
    const Triangle& T = work.mesh.triangles[t];
    if (!counts(T)) continue;
    const double q = shape(T.v[0], T.v[1], T.v[2]);
    all.sum += shape_cost(q);
    if (all.sum > most) break;
    all.worst = std::min(all.worst, q);
  }
  all.mean = count > 0 ? all.sum / count : 0;
  return all;
}

ZoneCost SearchZone::cost(double enough) {
  ZoneCost all = cost_of_shapes(enough);
  if (all.mean > enough) return all;
  for (const std::int32_t t : triangles) {
    const Triangle& T = work.mesh.triangles[t];
    if (T.v[0] >= 0 && T.done != Done::frozen) add_edges(T, t, all);
  }
  return all;
}

double SearchZone::shape(int p, int q, int r) {
  const PlaceKey key = key_of_triangle(places[p], places[q], places[r]);
  if (const double* known = known_shapes_.find(key)) return *known;
  ++shapes_asked;
  const double found = work.shapes.quality_at_centroid(p, q, r);
  known_shapes_.put(key, found);
  return found;
}

Vec3 SearchZone::normal(int v) {
  if (const Vec3* known = known_normals_.find(places[v])) return *known;
  const Vec3 found = normals_->at(work.field.outward(work.mesh.at(v)));
  known_normals_.put(places[v], found);
  return found;
}

void SearchZone::place(int v, Vec2 p) {
  Vertex& P = work.mesh.vertices[v];
  P.x = p.x(), P.y = p.y();
  P.set_metric(work.field.at(p));
  places[v] = key_of_place(p);
}

void SearchZone::split(int t, int i) {
  Triangulation& mesh = work.mesh;
  const Triangle& T = mesh.triangles[t];
  const Vec2 p = 0.5 * (mesh.at(T.v[next3[i]]) + mesh.at(T.v[prev3[i]]));
  const auto m = static_cast<std::int32_t>(mesh.vertices.size());
  mesh.vertices.push_back({p.x(), p.y()});
  work.shapes.set_metric(m);
  places.push_back(key_of_place(p));
  mesh.split_edge(t, i, m);
  const auto last = static_cast<std::int32_t>(mesh.triangles.size()) - 1;
  triangles.push_back(last - 1), triangles.push_back(last);
  movable.push_back(m);
}

}  // namespace carreau::plane
