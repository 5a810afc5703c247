// SPDX-License-Identifier: BSD-3-Clause
#include "plane/kernel/star.h"

#include <algorithm>

namespace carreau::plane {

bool Star::collect(const Triangulation& mesh, int v) {
  triangles.clear();
  link.clear();
  const int start = mesh.vertices[v].triangle;
  int t = start;
  do {
    const Triangle& T = mesh.triangles[t];
    const int k = mesh.corner_of(t, v);
    triangles.push_back(t);
    link.push_back(T.v[next3[k]]);
    if (T.n[next3[k]] == no_edge) return false;
    t = T.n[next3[k]] >> 2;
  } while (t != start);
  return true;
}

bool has_imposed_spoke(const Triangulation& mesh, const Star& star, int v) {
  return std::any_of(star.triangles.begin(), star.triangles.end(), [&](std::int32_t t) {
    return mesh.triangles[t].imposed != 0 && mesh.is_imposed(t, next3[mesh.corner_of(t, v)]);
  });
}

namespace {

// The outer edge of triangle `gone` takes the place of the edge between it and `kept`.
void close_over(Triangulation& mesh, int v, int gone, int kept, bool kept_after) {
  const int outer = mesh.corner_of(gone, v), corner = mesh.corner_of(kept, v);
  const int i = kept_after ? prev3[corner] : next3[corner];
  const HalfEdge beyond = mesh.triangles[gone].n[outer];
  Triangle& K = mesh.triangles[kept];
  K.n[i] = beyond;
  const auto copy_bit = [&](std::uint8_t& bits, std::uint8_t from) {
    bits = static_cast<std::uint8_t>((bits & ~(1U << i)) | static_cast<unsigned>(from >> outer & 1) << i);
  };
  copy_bit(K.imposed, mesh.triangles[gone].imposed);
  copy_bit(K.degenerate, mesh.triangles[gone].degenerate);
  if (beyond != no_edge) mesh.triangles[beyond >> 2].n[beyond & 3] = 4 * kept + i;
}

}  // namespace

void collapse(Triangulation& mesh, const Star& star, int v, int k) {
  const auto n = static_cast<int>(star.link.size());
  const int u = star.link[k], last = star.triangles[(k + n - 1) % n], first = star.triangles[k];
  close_over(mesh, v, first, star.triangles[(k + 1) % n], true);
  close_over(mesh, v, last, star.triangles[(k + n - 2) % n], false);
  for (int j = 1; j + 1 < n; ++j) {
    const int t = star.triangles[(k + j) % n];
    Triangle& T = mesh.triangles[t];
    T.v[mesh.corner_of(t, v)] = u;
    for (const std::int32_t w : T.v) mesh.vertices[w].triangle = t;
  }
  mesh.vertices[v].triangle = -1;
  for (const int gone : {first, last}) mesh.triangles[gone] = {};
}

}  // namespace carreau::plane
