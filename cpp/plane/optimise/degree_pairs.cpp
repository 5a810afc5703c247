// Pairs of vertices with five and seven neighbours: where a row of the mesh ends. Where sizes grow some must be; of the
// others many find a partner a few edges away that they cancel with.
#include <algorithm>

#include "plane/optimise/optimiser.h"

namespace carreau::plane {

namespace {

constexpr int vertices_between_checks = 1 << 14;
// A row that is shifted by one edge leaves triangles of 0.6 until vertices move; none may be much worse.
constexpr double glide_quality = 0.5;
// Mean squared length of a vertex' edges below which it may go, and of the longest edge and for the worst triangle that
// are left.
constexpr double dense_length2 = 0.9, longest_thinned2 = 2.6, thinned_quality = 0.45;

}  // namespace

// Change of the sum of squares of the excesses by a swap.
int Optimiser::swap_gain(int t, int i) const {
  const Triangle& A = mesh_.triangles[t];
  const HalfEdge o = A.n[i];
  return 2 * (excess(A.v[i]) + excess(mesh_.triangles[o >> 2].v[o & 3]) - excess(A.v[next3[i]]) -
              excess(A.v[prev3[i]])) +
         4;
}

bool Optimiser::can_glide(int t, int i) const {
  const Triangle& A = mesh_.triangles[t];
  const HalfEdge o = A.n[i];
  if (o == no_edge || (A.imposed >> i & 1) != 0) return false;
  const int c = A.v[i], a = A.v[next3[i]], b = A.v[prev3[i]], d = mesh_.triangles[o >> 2].v[o & 3];
  return shapes_.quality(c, a, d) > glide_quality && shapes_.quality(c, d, b) > glide_quality;
}

void Optimiser::swap_counted(int t, int i) {
  const Triangle& A = mesh_.triangles[t];
  --degree_[A.v[next3[i]]], --degree_[A.v[prev3[i]]];
  ++degree_[A.v[i]], ++degree_[mesh_.triangles[A.n[i] >> 2].v[A.n[i] & 3]];
  mesh_.swap_edge(t, i);
}

// A swap in the triangles around v that brings degrees nearer to six.
bool Optimiser::swap_around(int v) {
  const int start = mesh_.vertices[v].triangle;
  int t = start;
  do {
    const Triangle& T = mesh_.triangles[t];
    for (int i = 0; i < 3; ++i)
      if (T.n[i] != no_edge && swap_gain(t, i) < 0 && can_glide(t, i)) {
        swap_counted(t, i);
        return true;
      }
    const HalfEdge after = T.n[next3[mesh_.corner_of(t, v)]];
    if (after == no_edge) return false;
    t = after >> 2;
  } while (t != start);
  return false;
}

// The pair takes up to `reach` steps along its row, each a swap that gives the next two vertices its degrees, until it
// meets something that it becomes smaller with; else all is as before.
bool Optimiser::glide(int seven, int five, bool left, int reach) {
  glided_.clear();
  for (int step = 0; step < reach; ++step) {
    const HalfEdge he = mesh_.find_edge(seven, five);
    const HalfEdge other = mesh_.triangles[he >> 2].n[he & 3];
    if (other == no_edge) break;
    const bool on_left = mesh_.triangles[he >> 2].v[next3[he & 3]] == seven;
    const int t = (on_left == left ? he : other) >> 2, i = mesh_.corner_of(t, five);
    const Triangle& T = mesh_.triangles[t];
    if (!can_glide(t, i)) break;
    const int b = T.v[next3[i]] == seven ? T.v[prev3[i]] : T.v[next3[i]];
    const int d = mesh_.triangles[T.n[i] >> 2].v[T.n[i] & 3];
    const int gain = swap_gain(t, i);
    if (gain > 0 || (gain == 0 && (excess(b) != 0 || b < fixed_ || d < fixed_))) break;
    swap_counted(t, i);
    if (gain < 0 || swap_around(d) || swap_around(b)) return true;
    glided_.emplace_back(five, d);
    seven = d, five = b;
  }
  for (; !glided_.empty(); glided_.pop_back()) {
    const HalfEdge he = mesh_.find_edge(glided_.back().first, glided_.back().second);
    swap_counted(he >> 2, he & 3);
  }
  return false;
}

// Expects degrees to be counted.
void Optimiser::cancel_pairs(int reach) {
  const auto n = static_cast<int>(mesh_.vertices.size());
  for (int v = fixed_; v < n; ++v) {
    if (v % vertices_between_checks == 0) monitor_.checkpoint();
    if (mesh_.vertices[v].triangle < 0 || excess(v) < 1 || swap_around(v) || excess(v) != 1 || !collect_star(v))
      continue;
    const std::size_t around = ring_.size();
    for (std::size_t k = 0; k < around; ++k) {
      const int w = ring_[k];
      if (w >= fixed_ && excess(w) == -1 && (glide(v, w, true, reach) || glide(v, w, false, reach))) break;
    }
  }
}

// Where points are dense, a vertex with few neighbours goes into one of them, when degrees get no farther from six: a
// row ends one point earlier.
void Optimiser::thin_out() {
  const std::size_t before = mesh_.vertices.size();
  bool any = false;
  for (int v = fixed_; v < static_cast<int>(before); ++v) {
    if (v % vertices_between_checks == 0) monitor_.checkpoint();
    if (mesh_.vertices[v].triangle < 0 || excess(v) > -1 || !collect_star(v) || has_imposed_spoke(v)) continue;
    const auto n = static_cast<int>(ring_.size());
    double sum = 0;
    for (const std::int32_t u : ring_) sum += shapes_.squared_length(u, v);
    if (sum > dense_length2 * n) continue;
    int into = -1, least_change = 1;
    double best = thinned_quality;
    for (int k = 0; k < n; ++k) {
      const int u = ring_[k], a = ring_[(k + n - 1) % n], b = ring_[(k + 1) % n];
      const int joined = excess(u) + excess(v) + 2;
      const int change =
          joined * joined - excess(u) * excess(u) - excess(v) * excess(v) + 2 - 2 * (excess(a) + excess(b));
      if (change > std::min(least_change, 0)) continue;
      double worst = 1;
      for (int j = 1; j + 1 < n && worst > thinned_quality; ++j) {
        const int x = ring_[(k + j) % n];
        worst = std::min(worst, shapes_.quality(u, x, ring_[(k + j + 1) % n]));
        if (j > 1 && shapes_.squared_length(u, x) > longest_thinned2) worst = 0;
      }
      if (worst <= (change < least_change ? thinned_quality : best)) continue;
      into = k, least_change = change, best = worst;
    }
    if (into < 0) continue;
    const int degree = degree_[v];
    const int u = ring_[into];
    --degree_[ring_[(into + n - 1) % n]], --degree_[ring_[(into + 1) % n]];
    degree_[u] = static_cast<std::uint8_t>(degree_[u] + degree - 4);
    collapse(v, into);
    any = true;
  }
  if (any) drop_removed();
}

// The last triangles of the list take the places of those that are removed.
void Optimiser::drop_removed() {
  auto& triangles = mesh_.triangles;
  for (std::size_t t = 0; t < triangles.size();) {
    if (triangles[t].v[0] >= 0) {
      ++t;
      continue;
    }
    triangles[t] = triangles.back();
    triangles.pop_back();
    if (t == triangles.size() || triangles[t].v[0] < 0) continue;
    const auto place = static_cast<std::int32_t>(t);
    for (int i = 0; i < 3; ++i) {
      const HalfEdge n = triangles[t].n[i];
      if (n != no_edge) triangles[n >> 2].n[n & 3] = 4 * place + i;
      mesh_.vertices[triangles[t].v[i]].triangle = place;
    }
  }
}

}  // namespace carreau::plane
