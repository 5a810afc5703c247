// SPDX-License-Identifier: BSD-3-Clause
#include "plane/optimise/mending.h"

#include <algorithm>
#include <cmath>

#include "mesh/shape_levels.h"
#include "metric/unit_edge.h"
#include "plane/kernel/thresholds.h"
#include "plane/optimise/star_cost.h"
#include "support/infinity.h"

namespace carreau::plane {

namespace {

// Moves minimise this: bad triangles have a high penalty; a triangle that is turned over has an infinite one.
double penalty(double quality) noexcept { return quality > 0 ? 1 / (quality * quality) : infinity; }
// The penalty of the best shape, 1, less a thousandth for the rounding of very stretched metrics.
constexpr double min_penalty = 0.999;

double shape(const Mending& m, const Triangle& T) { return m.work.shapes.quality_at_centroid(T.v[0], T.v[1], T.v[2]); }

bool swap(Mending& m, int t) {
  Triangulation& mesh = m.work.mesh;
  const Shapes& shapes = m.work.shapes;
  for (int i = 0; i < 3; ++i) {
    if (!mesh.can_swap(t, i)) continue;
    const Triangle &T = mesh.triangles[t], &U = mesh.triangles[T.n[i] >> 2];
    const int c = T.v[i], a = T.v[next3[i]], b = T.v[prev3[i]], d = U.v[T.n[i] & 3];
    const double before = std::min(shapes.quality_at_centroid(c, a, b), shapes.quality_at_centroid(d, b, a));
    const double after = std::min(shapes.quality_at_centroid(c, a, d), shapes.quality_at_centroid(c, d, b));
    if (after <= before + shape_level::gain) continue;
    m.changed.push_back(t);
    m.changed.push_back(T.n[i] >> 2);
    mesh.swap_edge(t, i);
    return true;
  }
  return false;
}

// Moves to the best of places around, at shrinking distances in the metric; true if that gains. Uses the collected link.
bool move_to_best(Mending& m, int v) {
  Triangulation& mesh = m.work.mesh;
  Vertex& P = mesh.vertices[v];
  StarBound bound{.least = min_penalty};
  const auto cost = [&](double enough) {
    return bounded_star_cost(m.work.shapes, v, m.star.link, enough, penalty, bound, m.shapes_asked);
  };
  const double before = cost(infinity);
  double best = before;
  for (double step = 0.24; step > 0.02; step *= 0.5) {
    const UnitCircle circle(P.metric());
    const Vec2 centre = P.point();
    for (const Vec2& d : six_directions) {
      const Vertex kept = P;
      const Vec2 to = centre + circle.vector(step * d);
      P.x = to.x(), P.y = to.y();
      // Shapes depend on it only if the field bends.
      if (!mesh.bends.empty()) P.set_metric(m.work.field.at(P.point()));
      const double now = cost(best);
      if (now < best)
        best = now, P.set_metric(m.work.field.at(P.point()));
      else
        P = kept;
    }
  }
  return best < before * (1 - shape_level::gain);
}

bool move(Mending& m, int v) {
  const Triangulation& mesh = m.work.mesh;
  if (!m.star.collect(mesh, v)) return false;
  const auto key = [&] { return key_of_star(v, m.star.link, [&](int u) { return key_of_place(mesh.at(u)); }); };
  const PlaceKey star = key();
  if (m.failed_moves.find(star) != nullptr) return false;
  if (!move_to_best(m, v)) {
    // Small steps that gain little are kept even so.
    if (key() == star)
      m.failed_moves.put(star, true);
    else
      m.nudged.insert(m.nudged.end(), m.star.triangles.begin(), m.star.triangles.end());
    return false;
  }
  m.changed.insert(m.changed.end(), m.star.triangles.begin(), m.star.triangles.end());
  return true;
}

// Removes a vertex that moves freely by merging it into one of its neighbours, if no edge becomes long and the worst
// triangle improves. If vertices are crowded, the worst triangle only must not become bad.
bool remove(Mending& m, int v, bool crowded) {
  Triangulation& mesh = m.work.mesh;
  if (!m.star.collect(mesh, v) || has_imposed_spoke(mesh, m.star, v)) return false;
  const Shapes& shapes = m.work.shapes;
  const auto& link = m.star.link;
  const auto n = static_cast<int>(link.size());
  double worst = 1;
  for (int k = 0; k < n; ++k) worst = std::min(worst, shapes.quality_at_centroid(v, link[k], link[(k + 1) % n]));
  const double least =
      crowded ? std::max(std::min(worst, shape_level::poor) - shape_level::gain, 0.0) : worst + shape_level::gain;
  const double longest2 = crowded ? longest_uncrowded2 : unit_edge::longest * unit_edge::longest;
  const int into = best_collapse(m.star, least, 0, [&](int u, int a, int b, bool inner) {
    return inner && shapes.squared_length(u, a) > longest2 ? 0 : shapes.quality_at_centroid(u, a, b);
  });
  if (into < 0) return false;
  collapse(mesh, m.star, v, into);
  m.changed.insert(m.changed.end(), m.star.triangles.begin(), m.star.triangles.end());
  return true;
}

// The worst shape of the cavity that was dug.
double worst_of_cavity(const Mending& m) {
  double worst = 1;
  for (const std::int32_t c : m.work.mesh.cavity()) worst = std::min(worst, shape(m, m.work.mesh.triangles[c]));
  return worst;
}

PlaceKey key_of_cavity(const Triangulation& mesh, const Vec2& p, bool spaced) {
  PlaceKey key = 5 * key_of_place(p) + (spaced ? 1 : 0);
  for (const std::int32_t c : mesh.cavity()) {
    const Triangle& C = mesh.triangles[c];
    key += key_of_triangle(key_of_place(mesh.at(C.v[0])), key_of_place(mesh.at(C.v[1])), key_of_place(mesh.at(C.v[2])));
  }
  return key;
}

// The worst shape around the new vertex v, whose link is collected; 0 if it makes an edge too short.
double worst_around(const Mending& m, int v, bool spaced) {
  const auto& link = m.star.link;
  double worst = 1;
  for (std::size_t k = 0; k < link.size(); ++k) {
    worst = std::min(worst, m.work.shapes.quality_at_centroid(v, link[k], link[k + 1 < link.size() ? k + 1 : 0]));
    if (spaced && m.work.shapes.squared_length(v, link[k]) < crowded_length2) worst = 0;
  }
  return worst;
}

// Adds a vertex near p, at the best place for the triangles about it, if the worst of these improves. `spaced`: and if
// it makes no edge as short as the removed edges.
bool insert(Mending& m, Vec2 p, int t, bool spaced) {
  Triangulation& mesh = m.work.mesh;
  const int start = is_finite(p) ? mesh.locate(p, t) : -1;
  if (start < 0 || !mesh.dig(p, m.work.field.at(p), start, {})) return false;
  m.shapes_asked += static_cast<std::int64_t>(mesh.cavity().size() + mesh.rim().size());
  for (const std::int32_t c : mesh.cavity())
    if (mesh.triangles[c].done == Done::frozen) return false;
  const PlaceKey key = key_of_cavity(mesh, p, spaced);
  if (m.failed_points.find(key) != nullptr) return false;
  const double before = worst_of_cavity(m);
  const auto v = static_cast<std::int32_t>(mesh.vertices.size());
  mesh.vertices.push_back({p.x(), p.y()});
  if (!mesh.bends.empty()) mesh.bends.push_back(Bend::none);
  m.work.shapes.set_metric(v);
  m.star.link.clear();
  for (const RimEdge& r : mesh.rim()) m.star.link.push_back(mesh.rim_point(r.a).v);
  if (spaced) {
    move_to_best(m, v);
    m.work.shapes.set_metric(v);
  }
  if (worst_around(m, v, spaced) <= before + shape_level::gain) {
    mesh.vertices.pop_back();
    if (!mesh.bends.empty()) mesh.bends.pop_back();
    m.failed_points.put(key, true);
    return false;
  }
  mesh.fill(v);
  m.changed.insert(m.changed.end(), mesh.star().begin(), mesh.star().end());
  return true;
}

// For a triangle on an edge much shorter than its sides: adds a vertex over that edge, if this improves triangles. At a
// short imposed edge in large sizes, shape requires points that size does not.
bool insert_over_short_edge(Mending& m, int t) {
  const auto& vertices = m.work.mesh.vertices;
  const Triangle& T = m.work.mesh.triangles[t];
  const Vertex* V[3] = {&vertices[T.v[0]], &vertices[T.v[1]], &vertices[T.v[2]]};
  const Metric2 mean = (1.0 / 3) * (V[0]->metric() + V[1]->metric() + V[2]->metric());
  int i = 0;
  double l2[3];
  for (int k = 0; k < 3; ++k) l2[k] = squared_length(mean, V[prev3[k]]->point() - V[next3[k]]->point());
  for (int k = 1; k < 3; ++k)
    if (l2[k] < l2[i]) i = k;
  const Vec2 a = V[next3[i]]->point(), b = V[prev3[i]]->point(), e = b - a;
  const double k = over_short_edge / std::sqrt(std::max(determinant(mean), 1e-300));
  const Vec2 p{0.5 * (a.x() + b.x()) - k * (mean.b * e.x() + mean.c * e.y()),
               0.5 * (a.y() + b.y()) + k * (mean.a * e.x() + mean.b * e.y())};
  return insert(m, p, t, false);
}

// Halves an edge of a bad triangle, or of one beside it, if a vertex fits. The layers of two borders that meet at a
// corner may leave one triangle in place of three.
bool halve_edge(Mending& m, int t) {
  const Triangulation& mesh = m.work.mesh;
  const Triangle T = mesh.triangles[t];
  const auto halve = [&](int s, int i) {
    const Triangle& S = mesh.triangles[s];
    const int a = S.v[next3[i]], b = S.v[prev3[i]];
    return !mesh.is_imposed(s, i) && m.work.shapes.squared_length(a, b) > unit_edge::longest * unit_edge::longest &&
           insert(m, 0.5 * (mesh.at(a) + mesh.at(b)), s, true);
  };
  for (int i = 0; i < 3; ++i) {
    if (halve(t, i)) return true;
    if (T.n[i] == no_edge || mesh.is_imposed(t, i)) continue;
    const int s = T.n[i] >> 2, k = T.n[i] & 3;
    if (halve(s, next3[k]) || halve(s, prev3[k])) return true;
  }
  return false;
}

}  // namespace

bool is_crowded(const PlaneWork& work, int t) {
  const Triangle& T = work.mesh.triangles[t];
  for (int i = 0; i < 3; ++i)
    if (work.shapes.squared_length(T.v[next3[i]], T.v[prev3[i]]) < crowded_length2 && !work.mesh.is_imposed(t, i))
      return true;
  return false;
}

bool remove_crowded_vertex(Mending& m, int t) {
  const Triangle& T = m.work.mesh.triangles[t];
  for (int i = 0; i < 3; ++i) {
    const int a = T.v[next3[i]], b = T.v[prev3[i]];
    if (m.work.shapes.squared_length(a, b) >= crowded_length2 || m.work.mesh.is_imposed(t, i)) continue;
    for (const int v : {a, b})
      if (v >= m.work.fixed && remove(m, v, true)) return true;
  }
  return false;
}

bool mend(Mending& m, int t) {
  if (is_crowded(m.work, t)) {
    if (remove_crowded_vertex(m, t)) return true;
    if (shape(m, m.work.mesh.triangles[t]) >= shape_level::good) return false;
  }
  bool any = swap(m, t);
  for (int i = 0; i < 3; ++i) {
    const int v = m.work.mesh.triangles[t].v[i];
    if (v >= m.work.fixed) any = move(m, v) || any;
  }
  const Triangle& T = m.work.mesh.triangles[t];
  if (shape(m, T) >= shape_level::good) return any;
  for (int i = 0; i < 3; ++i) {
    const int v = m.work.mesh.triangles[t].v[i];
    if (v >= m.work.fixed && remove(m, v, false)) return true;
  }
  if (halve_edge(m, t)) return true;
  if (shape(m, m.work.mesh.triangles[t]) >= refine_quality) return any;
  return insert_over_short_edge(m, t) || any;
}

}  // namespace carreau::plane
