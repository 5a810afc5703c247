// SPDX-License-Identifier: BSD-3-Clause
// A walk over the edges of a large mesh that finds memory in order. Private to plane/optimise.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "plane/kernel/triangulation.h"
#include "plane/thresholds.h"
#include "support/monitor.h"

namespace carreau::plane {

inline constexpr std::int32_t triangles_at_once = 256;

/// Half-edges of the triangles from `first` to before `end` whose neighbour has a larger number, without a branch that
/// a processor could not predict.
inline void list_edges(const Triangulation& mesh, std::int32_t first, std::int32_t end, std::vector<HalfEdge>& edges) {
  edges.resize(static_cast<std::size_t>(3) * triangles_at_once);
  HalfEdge* to = edges.data();
  for (std::int32_t t = first; t < end; ++t) {
    const Triangle& T = mesh.triangles[t];
    for (int i = 0; i < 3; ++i) {
      *to = 4 * t + i;
      to += (T.n[i] >> 2) > t ? 1 : 0;
    }
  }
  edges.resize(static_cast<std::size_t>(to - edges.data()));
}

/// Calls for what the edges some places after k will ask for.
inline void prefetch_beyond(const Triangulation& mesh, const std::vector<HalfEdge>& edges, std::size_t k) {
  constexpr std::size_t far = 24, near = 12;
  if (k + far < edges.size()) {
    const HalfEdge he = edges[k + far];
    const Triangle& T = mesh.triangles[he >> 2];
    prefetch(&mesh.triangles[T.n[he & 3] >> 2]);
    for (const std::int32_t v : T.v) prefetch(&mesh.vertices[v]);
  }
  if (k + near < edges.size()) {
    const HalfEdge o = mesh.triangles[edges[k + near] >> 2].n[edges[k + near] & 3];
    if (o >= 0) prefetch(&mesh.vertices[mesh.triangles[o >> 2].v[o & 3]]);
  }
}

/// Calls use(t, i) for the inner edges, batch by batch: what `use` swaps is seen by the batches after.
template <typename Use>
void for_inner_edges(const Triangulation& mesh, Monitor& monitor, const Use& use) {
  std::vector<HalfEdge> edges;
  const auto total = static_cast<std::int32_t>(mesh.triangles.size());
  for (std::int32_t first = 0; first < total; first += triangles_at_once) {
    if (first % steps_between_checks == 0) monitor.checkpoint();
    list_edges(mesh, first, std::min(total, first + triangles_at_once), edges);
    for (std::size_t k = 0; k < edges.size(); ++k) {
      prefetch_beyond(mesh, edges, k);
      use(edges[k] >> 2, edges[k] & 3);
    }
  }
}

}  // namespace carreau::plane
