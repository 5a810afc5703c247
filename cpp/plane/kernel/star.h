// SPDX-License-Identifier: BSD-3-Clause
// The triangles around a vertex, and operations on them as a whole.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "plane/kernel/triangulation.h"

namespace carreau::plane {

/// Counterclockwise: side k of the link, from link[k] to link[k + 1], is the edge of triangles[k] opposite to the
/// vertex.
struct Star {
  std::vector<std::int32_t> triangles, link;

  /// Collects the star of vertex v. False: v lies on the border, and only a part was collected.
  bool collect(const Triangulation& mesh, int v);
};

/// True if an edge at v, whose star is given, is imposed.
[[nodiscard]] bool has_imposed_spoke(const Triangulation& mesh, const Star& star, int v);

/// Draws v, whose star it is, into its neighbour link[k]. The vertex loses its triangle; the two triangles on that edge
/// lose their vertices (-1).
void collapse(Triangulation& mesh, const Star& star, int v, int k);

/// The k for collapse() that leaves the best of worst triangles, better than `best` by the share `gain`; -1: none does.
/// quality(u, a, b, inner): of the triangle that u = link[k] makes; `inner`: u - a is no edge yet.
template <typename Quality>
[[nodiscard]] int best_collapse(const Star& star, double best, double gain, const Quality& quality) {
  const auto& link = star.link;
  const auto n = static_cast<int>(link.size());
  int into = -1;
  for (int k = 0; k < n; ++k) {
    double least = 1;
    for (int j = 1; j + 1 < n && least > best; ++j)
      least = std::min(least, quality(link[k], link[(k + j) % n], link[(k + j + 1) % n], j > 1));
    if (least > best * (1 + gain)) best = least, into = k;
  }
  return into;
}

/// Calls use(t) for each triangle around v, which may lie on the border.
template <typename Use>
void for_each_around(const Triangulation& mesh, int v, const Use& use) {
  const int start = mesh.vertices[v].triangle;
  int t = start;
  do {  // counterclockwise, until round or at the border
    use(t);
    const HalfEdge after = mesh.triangles[t].n[next3[mesh.corner_of(t, v)]];
    if (after == no_edge) break;
    t = after >> 2;
    if (t == start) return;
  } while (true);
  for (t = start;;) {
    const HalfEdge before = mesh.triangles[t].n[prev3[mesh.corner_of(t, v)]];
    if (before == no_edge) return;
    t = before >> 2;
    use(t);
  }
}

}  // namespace carreau::plane
