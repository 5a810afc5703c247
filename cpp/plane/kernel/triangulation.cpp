// SPDX-License-Identifier: BSD-3-Clause
#include "plane/kernel/triangulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "plane/kernel/thresholds.h"
#include "predicates/predicates.h"
#include "support/work_sizes.h"

namespace carreau::plane {

int Triangulation::walk(const Vec2& p, int hint, std::size_t max_steps) const noexcept {
  const Triangle* const T = triangles.data();
  const Vertex* const V = vertices.data();
  int t = hint, from = -1;
  std::uint32_t turn = 1;
  for (std::size_t step = 0; step < max_steps; ++step) {
    const Triangle& now = T[t];
    // In a triangulation that is not Delaunay a fixed order could go round in circles.
    int first = 0;
    // In a triangulation that is not Delaunay a fixed order could go round in circles. [20 and 80: no figure changes; without it a walk may
    // not end]
    if (step > 40) {
      turn = turn * 1664525U + 1013904223U;
      first = static_cast<int>((turn >> 16) % 3);
    }
    bool moved = false, blocked = false;
    for (int k = 0; k < 3; ++k) {
      const int i = first + k < 3 ? first + k : first + k - 3;
      if (i == from) continue;
      if (orientation(V[now.v[next3[i]]].point(), V[now.v[prev3[i]]].point(), p) >= 0) continue;
      if (now.n[i] == no_edge || (now.imposed >> i & 1) != 0) {
        blocked = true;
        continue;
      }
      from = now.n[i] & 3;
      t = now.n[i] >> 2;
      moved = true;
      break;
    }
    if (!moved) return blocked ? blocked_walk : t;
  }
  return unfinished_walk;
}

int Triangulation::locate_near(const Vec2& p, int hint, int max_steps) const noexcept {
  return std::max(walk(p, hint, static_cast<std::size_t>(max_steps)), blocked_walk);
}

int Triangulation::locate(const Vec2& p, int hint) const noexcept {
  const int t = walk(p, hint, 2 * triangles.size() + 100);
  if (t != unfinished_walk) return t;
  // Only a walk of unheard-of bad luck comes here.
  const Triangle* const T = triangles.data();
  for (std::size_t s = 0; s < triangles.size(); ++s) {
    const Triangle& now = T[s];
    if (orientation(at(now.v[0]), at(now.v[1]), p) >= 0 && orientation(at(now.v[1]), at(now.v[2]), p) >= 0 &&
        orientation(at(now.v[2]), at(now.v[0]), p) >= 0)
      return static_cast<int>(s);
  }
  return -1;
}

void Triangulation::renumber_if_large() {
  // Larger meshes do not fit in the cache and are sorted once. [time only]
  if (triangles.size() < 200'000) return;
  // Counting sort by the largest vertex of each.
  const auto key = [](const Triangle& T) { return std::max({T.v[0], T.v[1], T.v[2]}); };
  std::vector<std::int32_t> next(vertices.size() + 1, 0), rank(triangles.size());
  for (const Triangle& T : triangles) ++next[key(T) + 1];
  for (std::size_t v = 0; v + 1 < next.size(); ++v) next[v + 1] += next[v];
  for (std::size_t t = 0; t < triangles.size(); ++t) rank[t] = next[key(triangles[t])]++;
  std::vector<Triangle> sorted;
  // The local search that follows adds few: without room for them the array would be copied to one of twice its size.
  sorted.reserve(triangles.size() + triangles.size() / 32);
  sorted.resize(triangles.size());
  const std::size_t last = triangles.size() - 1;
  for (std::size_t t = 0; t <= last; ++t) {
    const std::size_t ahead = std::min(t + work_sizes::prefetched, last);
    prefetch(&sorted[rank[ahead]]);
    for (const HalfEdge n : triangles[ahead].n) prefetch(&rank[std::max(n, 0) >> 2]);
    Triangle T = triangles[t];
    for (HalfEdge& n : T.n)
      if (n != no_edge) n = 4 * rank[n >> 2] + (n & 3);
    sorted[rank[t]] = T;
  }
  triangles.swap(sorted);
  for (Vertex& v : vertices) v.triangle = rank[v.triangle];
}

void Triangulation::drop_removed() {
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
      vertices[triangles[t].v[i]].triangle = place;
    }
  }
}

bool Triangulation::can_swap(int t, int i) const noexcept {
  const Triangle& A = triangles[t];
  if (A.n[i] == no_edge || (A.imposed >> i & 1) != 0) return false;
  const Triangle& B = triangles[A.n[i] >> 2];
  const Vec2 c = at(A.v[i]), a = at(A.v[next3[i]]), b = at(A.v[prev3[i]]), d = at(B.v[A.n[i] & 3]);
  return orientation(c, a, d) > 0 && orientation(c, d, b) > 0;
}

void Triangulation::swap_edge(int t, int i) noexcept {
  Triangle& A = triangles[t];
  const int u = A.n[i] >> 2, j = A.n[i] & 3;
  Triangle& B = triangles[u];
  const auto bit = [](std::uint8_t bits, int k) { return static_cast<unsigned>(bits >> k & 1); };
  const auto pack = [](unsigned e0, unsigned e1, unsigned e2) {
    return static_cast<std::uint8_t>(e0 | e1 << 1 | e2 << 2);
  };
  const int c = A.v[i], a = A.v[next3[i]], b = A.v[prev3[i]], d = B.v[j];
  // Outer edges: bc and ca of A; ad and db of B (B is d, b, a from corner j).
  const HalfEdge bc = A.n[next3[i]], ca = A.n[prev3[i]], ad = B.n[next3[j]], db = B.n[prev3[j]];
  if ((A.imposed | B.imposed) != 0) {
    const auto rotate = [&](std::uint8_t& of_a, std::uint8_t& of_b) {
      const std::uint8_t a_bits = pack(bit(of_b, next3[j]), 0, bit(of_a, prev3[i]));
      of_b = pack(bit(of_b, prev3[j]), bit(of_a, next3[i]), 0);
      of_a = a_bits;
    };
    rotate(A.imposed, B.imposed);
    rotate(A.degenerate, B.degenerate);
  }
  A.v[0] = c, A.v[1] = a, A.v[2] = d;
  A.n[0] = ad, A.n[1] = 4 * u + 2, A.n[2] = ca;
  B.v[0] = c, B.v[1] = d, B.v[2] = b;
  B.n[0] = db, B.n[1] = bc, B.n[2] = 4 * t + 1;
  if (ad != no_edge) triangles[ad >> 2].n[ad & 3] = 4 * t;
  if (ca != no_edge) triangles[ca >> 2].n[ca & 3] = 4 * t + 2;
  if (db != no_edge) triangles[db >> 2].n[db & 3] = 4 * u;
  if (bc != no_edge) triangles[bc >> 2].n[bc & 3] = 4 * u + 1;
  vertices[c].triangle = vertices[a].triangle = vertices[d].triangle = t;
  vertices[b].triangle = u;
}

void Triangulation::split_edge(int t, int i, int m) {
  const Triangle T = triangles[t], U = triangles[T.n[i] >> 2];
  const int u = T.n[i] >> 2, j = T.n[i] & 3;
  const int c = T.v[i], a = T.v[next3[i]], b = T.v[prev3[i]], d = U.v[j];
  const auto t2 = static_cast<std::int32_t>(triangles.size()), u2 = t2 + 1;
  const auto make = [&](int place, const Triangle& from, std::array<std::int32_t, 3> v, std::array<HalfEdge, 3> n,
                        int outer, int source) {
    Triangle& K = triangles[place];
    K = {};
    K.done = from.done;
    for (int k = 0; k < 3; ++k) K.v[k] = v[k], K.n[k] = n[k];
    K.imposed = static_cast<std::uint8_t>((from.imposed >> source & 1U) << outer);
    K.degenerate = static_cast<std::uint8_t>((from.degenerate >> source & 1U) << outer);
    if (n[outer] != no_edge) triangles[n[outer] >> 2].n[n[outer] & 3] = 4 * place + outer;
    for (const std::int32_t w : v) vertices[w].triangle = place;
  };
  triangles.resize(triangles.size() + 2);
  make(t, T, {c, a, m}, {4 * u, 4 * t2 + 2, T.n[prev3[i]]}, 2, prev3[i]);
  make(t2, T, {c, m, b}, {4 * u2, T.n[next3[i]], 4 * t + 1}, 1, next3[i]);
  make(u, U, {d, m, a}, {4 * t, U.n[next3[j]], 4 * u2 + 1}, 1, next3[j]);
  make(u2, U, {d, b, m}, {4 * t2, 4 * u + 2, U.n[prev3[j]]}, 2, prev3[j]);
}

HalfEdge Triangulation::find_edge(int u, int v) const noexcept {
  const int start = vertices[u].triangle;
  int t = start;
  do {  // counterclockwise, until round or at the border
    const Triangle& T = triangles[t];
    const int k = corner_of(t, u);
    if (T.v[next3[k]] == v) return 4 * t + prev3[k];
    if (T.v[prev3[k]] == v) return 4 * t + next3[k];
    const HalfEdge after = T.n[next3[k]];
    if (after == no_edge) break;
    t = after >> 2;
    if (t == start) return no_edge;
  } while (true);
  for (t = start;;) {  // the other way
    const Triangle& T = triangles[t];
    const int k = corner_of(t, u);
    if (T.v[next3[k]] == v) return 4 * t + prev3[k];
    if (T.v[prev3[k]] == v) return 4 * t + next3[k];
    const HalfEdge before = T.n[prev3[k]];
    if (before == no_edge) return no_edge;
    t = before >> 2;
  }
}

void Triangulation::impose(HalfEdge he, bool degenerate) noexcept {
  const auto set = [&](HalfEdge h) {
    Triangle& T = triangles[h >> 2];
    T.imposed = static_cast<std::uint8_t>(T.imposed | 1U << (h & 3));
    if (degenerate) T.degenerate = static_cast<std::uint8_t>(T.degenerate | 1U << (h & 3));
  };
  const HalfEdge other = triangles[he >> 2].n[he & 3];
  set(he);
  if (other != no_edge) set(other);
}

double Triangulation::squared_radius(int t) const noexcept {
  const Triangle& T = triangles[t];
  const Vertex &A = vertices[T.v[0]], &B = vertices[T.v[1]], &C = vertices[T.v[2]];
  const Metric2 m = (1.0 / 3) * (A.metric() + B.metric() + C.metric());
  const Vec2 u = B.point() - A.point(), v = C.point() - A.point();
  const double area = cross(u, v);
  return carreau::squared_length(m, u) * carreau::squared_length(m, v) * carreau::squared_length(m, u - v) /
         (4 * area * area * std::max(determinant(m), 1e-300));
}

double Triangulation::quality(int p, int q, int r) const noexcept {
  const Vertex &P = vertices[p], &Q = vertices[q], &R = vertices[r];
  if (orientation(P.point(), Q.point(), R.point()) <= 0) return 0;
  const Metric2 m = P.metric() + Q.metric() + R.metric();
  const Vec2 u = Q.point() - P.point(), v = R.point() - P.point();
  const double sum = carreau::squared_length(m, u) + carreau::squared_length(m, v) + carreau::squared_length(m, u - v);
  return 2 * std::numbers::sqrt3 * cross(u, v) * std::sqrt(std::max(determinant(m), 0.0)) / sum;
}

}  // namespace carreau::plane
