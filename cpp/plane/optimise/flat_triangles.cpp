// SPDX-License-Identifier: BSD-3-Clause
#include "plane/optimise/flat_triangles.h"

#include <algorithm>

#include "plane/kernel/star.h"
#include "plane/kernel/thresholds.h"
#include "predicates/predicates.h"

namespace carreau::plane {

namespace {

// Over the longest side; 0 unless counterclockwise (exactly).
double height(const Triangulation& mesh, int p, int q, int r) {
  const Vec2 P = mesh.at(p), Q = mesh.at(q), R = mesh.at(r);
  if (orientation(P, Q, R) <= 0) return 0;
  const Vec2 u = Q - P, v = R - P;
  return std::max(cross(u, v), 0.0) / std::max({dot(u, u), dot(v, v), dot(v - u, v - u)});
}

bool is_flat(const Triangulation& mesh, int t) {
  const Triangle& T = mesh.triangles[t];
  return T.v[0] >= 0 && T.done != Done::frozen && height(mesh, T.v[0], T.v[1], T.v[2]) < flat_height;
}

// Swaps to the higher triangles; returns true if neither of the two is flat.
bool raise_by_swap(Triangulation& mesh, int t) {
  const Triangle& T = mesh.triangles[t];
  int best = -1;
  double highest = flat_height;
  for (int i = 0; i < 3; ++i) {
    if (!mesh.can_swap(t, i)) continue;
    const int c = T.v[i], a = T.v[next3[i]], b = T.v[prev3[i]], d = mesh.triangles[T.n[i] >> 2].v[T.n[i] & 3];
    const double lower = std::min(height(mesh, c, a, d), height(mesh, c, d, b));
    if (lower > highest) highest = lower, best = i;
  }
  if (best < 0) return false;
  mesh.swap_edge(t, best);
  return true;
}

// If the edge under it is imposed, or all triangles around are flat: merges a vertex that moves freely into a
// neighbour.
bool raise_by_removal(PlaneWork& work, Star& star, int t) {
  Triangulation& mesh = work.mesh;
  for (const std::int32_t v : Triangle(mesh.triangles[t]).v) {
    if (v < work.fixed || !star.collect(mesh, v) || has_imposed_spoke(mesh, star, v)) continue;
    const int into =
        best_collapse(star, flat_height, 0, [&](int p, int q, int r, bool) { return height(mesh, p, q, r); });
    if (into < 0) continue;
    collapse(mesh, star, v, into);
    return true;
  }
  return false;
}

}  // namespace

// Raising a triangle may raise its neighbours, too.
bool raise_flat_triangles(PlaneWork& work, std::vector<std::int32_t> doubtful) {
  Triangulation& mesh = work.mesh;
  std::sort(doubtful.begin(), doubtful.end());
  doubtful.erase(std::unique(doubtful.begin(), doubtful.end()), doubtful.end());
  std::erase_if(doubtful, [&](std::int32_t t) { return !is_flat(mesh, t); });
  if (doubtful.empty()) return false;
  Star star;
  bool any = true;
  while (any) {
    work.monitor.checkpoint();
    any = false;
    for (const std::int32_t t : doubtful)
      if (is_flat(mesh, t)) any = raise_by_swap(mesh, t) || raise_by_removal(work, star, t) || any;
  }
  return true;
}

}  // namespace carreau::plane
