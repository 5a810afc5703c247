// SPDX-License-Identifier: BSD-3-Clause
#include "plane/optimise/degree_pairs.h"

#include <algorithm>
#include <utility>

#include "mesh/shape_levels.h"
#include "plane/kernel/star.h"
#include "plane/kernel/thresholds.h"
#include "support/work_sizes.h"

namespace carreau::plane {

namespace {

// Change of the sum of squares of the excesses by a swap.
int swap_gain(const Triangulation& mesh, const Degrees& degrees, int t, int i) {
  const Triangle& A = mesh.triangles[t];
  const HalfEdge o = A.n[i];
  return 2 * (degrees.excess(A.v[i]) + degrees.excess(mesh.triangles[o >> 2].v[o & 3]) - degrees.excess(A.v[next3[i]]) -
              degrees.excess(A.v[prev3[i]])) +
         4;
}

bool may_swap(const PlaneWork& work, int t, int i) {
  const Triangle& A = work.mesh.triangles[t];
  const HalfEdge o = A.n[i];
  if (o == no_edge || (A.imposed >> i & 1) != 0) return false;
  const int c = A.v[i], a = A.v[next3[i]], b = A.v[prev3[i]], d = work.mesh.triangles[o >> 2].v[o & 3];
  return work.shapes.quality(c, a, d) > shape_level::bad && work.shapes.quality(c, d, b) > shape_level::bad;
}

void swap_counted(Triangulation& mesh, Degrees& degrees, int t, int i) {
  const Triangle& A = mesh.triangles[t];
  --degrees.found[A.v[next3[i]]], --degrees.found[A.v[prev3[i]]];
  ++degrees.found[A.v[i]], ++degrees.found[mesh.triangles[A.n[i] >> 2].v[A.n[i] & 3]];
  mesh.swap_edge(t, i);
}

// A swap in the triangles around v that brings degrees nearer to six.
bool swap_around(PlaneWork& work, Degrees& degrees, int v) {
  Triangulation& mesh = work.mesh;
  const int start = mesh.vertices[v].triangle;
  int t = start;
  do {
    const Triangle& T = mesh.triangles[t];
    for (int i = 0; i < 3; ++i)
      if (T.n[i] != no_edge && swap_gain(mesh, degrees, t, i) < 0 && may_swap(work, t, i)) {
        swap_counted(mesh, degrees, t, i);
        return true;
      }
    const HalfEdge after = T.n[next3[mesh.corner_of(t, v)]];
    if (after == no_edge) return false;
    t = after >> 2;
  } while (t != start);
  return false;
}

struct Pair {
  int seven, five;
};

// The triangle beside the edge of the pair, on its left or right, or -1.
int triangle_beside(const Triangulation& mesh, Pair pair, bool left) {
  const HalfEdge he = mesh.find_edge(pair.seven, pair.five);
  const HalfEdge other = mesh.triangles[he >> 2].n[he & 3];
  if (other == no_edge) return -1;
  const bool on_left = mesh.triangles[he >> 2].v[next3[he & 3]] == pair.seven;
  return (on_left == left ? he : other) >> 2;
}

// The pair takes up to `reach` steps along its layer, each a swap that gives the next two vertices its degrees. It
// stops where a defect cancels a part of it; otherwise all steps are undone. `swapped`: scratch, the new diagonals.
bool move_pair(PlaneWork& work, Degrees& degrees, Pair pair, bool left, int reach,
               std::vector<std::pair<std::int32_t, std::int32_t>>& swapped) {
  Triangulation& mesh = work.mesh;
  swapped.clear();
  for (int step = 0; step < reach; ++step) {
    const int t = triangle_beside(mesh, pair, left);
    if (t < 0) break;
    const int i = mesh.corner_of(t, pair.five);
    const Triangle& T = mesh.triangles[t];
    if (!may_swap(work, t, i)) break;
    const int b = T.v[next3[i]] == pair.seven ? T.v[prev3[i]] : T.v[next3[i]];
    const int d = mesh.triangles[T.n[i] >> 2].v[T.n[i] & 3];
    const int gain = swap_gain(mesh, degrees, t, i);
    if (gain > 0 || (gain == 0 && (degrees.excess(b) != 0 || b < work.fixed || d < work.fixed))) break;
    swap_counted(mesh, degrees, t, i);
    if (gain < 0 || swap_around(work, degrees, d) || swap_around(work, degrees, b)) return true;
    swapped.emplace_back(pair.five, d);
    pair = {.seven = d, .five = b};
  }
  for (; !swapped.empty(); swapped.pop_back()) {
    const HalfEdge he = mesh.find_edge(swapped.back().first, swapped.back().second);
    swap_counted(mesh, degrees, he >> 2, he & 3);
  }
  return false;
}

// The link vertex into which v is best drawn; -1: none.
int best_neighbour(const PlaneWork& work, const Degrees& degrees, const Star& star, int v) {
  const auto& link = star.link;
  const auto n = static_cast<int>(link.size());
  int into = -1, min_change = 1;
  double best = refine_quality;
  for (int k = 0; k < n; ++k) {
    const int u = link[k], a = link[(k + n - 1) % n], b = link[(k + 1) % n];
    const int of_u = degrees.excess(u), of_v = degrees.excess(v), joined = of_u + of_v + 2;
    const int change = joined * joined - of_u * of_u - of_v * of_v + 2 - 2 * (degrees.excess(a) + degrees.excess(b));
    if (change > std::min(min_change, 0)) continue;
    double worst = 1;
    for (int j = 1; j + 1 < n && worst > refine_quality; ++j) {
      const int x = link[(k + j) % n];
      worst = std::min(worst, work.shapes.quality(u, x, link[(k + j + 1) % n]));
      if (j > 1 && work.shapes.squared_length(u, x) > longest_thinned2) worst = 0;
    }
    if (worst <= (change < min_change ? refine_quality : best)) continue;
    into = k, min_change = change, best = worst;
  }
  return into;
}

}  // namespace

void cancel_degree_pairs(PlaneWork& work, Degrees& degrees, int reach) {
  Star star;
  std::vector<std::pair<std::int32_t, std::int32_t>> swapped;
  const auto n = static_cast<int>(work.mesh.vertices.size());
  for (int v = work.fixed; v < n; ++v) {
    if (v % work_sizes::steps == 0) work.monitor.checkpoint();
    if (work.mesh.vertices[v].triangle < 0 || degrees.excess(v) < 1 || swap_around(work, degrees, v) ||
        degrees.excess(v) != 1 || !star.collect(work.mesh, v))
      continue;
    for (const std::int32_t w : star.link) {
      const Pair pair{.seven = v, .five = w};
      if (w >= work.fixed && degrees.excess(w) == -1 &&
          (move_pair(work, degrees, pair, true, reach, swapped) ||
           move_pair(work, degrees, pair, false, reach, swapped)))
        break;
    }
  }
}

void remove_surplus_vertices(PlaneWork& work, Degrees& degrees) {
  Star star;
  const auto n = static_cast<int>(work.mesh.vertices.size());
  bool any = false;
  for (int v = work.fixed; v < n; ++v) {
    if (v % work_sizes::steps == 0) work.monitor.checkpoint();
    if (work.mesh.vertices[v].triangle < 0 || degrees.excess(v) > -1 || !star.collect(work.mesh, v) ||
        has_imposed_spoke(work.mesh, star, v))
      continue;
    const std::size_t around = star.link.size();
    double sum = 0;
    for (const std::int32_t u : star.link) sum += work.shapes.squared_length(u, v);
    if (sum > dense_length2 * static_cast<double>(around)) continue;
    const int into = best_neighbour(work, degrees, star, v);
    if (into < 0) continue;
    const std::size_t k = static_cast<std::size_t>(into);
    auto& found = degrees.found;
    --found[star.link[(k + around - 1) % around]], --found[star.link[(k + 1) % around]];
    found[star.link[k]] = static_cast<std::uint8_t>(found[star.link[k]] + found[v] - 4);
    collapse(work.mesh, star, v, into);
    any = true;
  }
  if (any) work.mesh.drop_removed();
}

}  // namespace carreau::plane
