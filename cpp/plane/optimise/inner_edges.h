// SPDX-License-Identifier: BSD-3-Clause
// A walk over the edges of a large mesh that finds memory in order. Private to plane/optimise.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "plane/kernel/thresholds.h"
#include "plane/kernel/triangulation.h"
#include "support/monitor.h"
#include "support/work_sizes.h"

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

/// The edges between triangles t and u for which calls_for(t, u) is true: few.
template <typename CallsFor>
void list_calling_edges(const Triangulation& mesh, std::int32_t first, std::int32_t end, std::vector<HalfEdge>& edges,
                        const CallsFor& calls_for) {
  edges.clear();
  for (std::int32_t t = first; t < end; ++t) {
    const HalfEdge* const n = mesh.triangles[t].n;
    const std::int32_t u[3] = {std::max(n[0] >> 2, t), std::max(n[1] >> 2, t), std::max(n[2] >> 2, t)};
    if ((static_cast<int>(calls_for(t, u[0])) | static_cast<int>(calls_for(t, u[1])) |
         static_cast<int>(calls_for(t, u[2]))) == 0)
      continue;
    for (int i = 0; i < 3; ++i)
      if (u[i] > t && calls_for(t, u[i])) edges.push_back(4 * t + i);
  }
}

/// Prefetches the data that edges some places after k need.
inline void prefetch_beyond(const Triangulation& mesh, const std::vector<HalfEdge>& edges, std::size_t k) {
  constexpr std::size_t far = 24, near = 12;
  if (k + far < edges.size()) {
    const HalfEdge he = edges[k + far];
    const Triangle& T = mesh.triangles[he >> 2];
    if (const HalfEdge beyond = T.n[he & 3]; beyond >= 0) prefetch(&mesh.triangles[beyond >> 2]);
    for (const std::int32_t v : T.v) prefetch(&mesh.vertices[v]);
  }
  if (k + near < edges.size()) {
    const HalfEdge o = mesh.triangles[edges[k + near] >> 2].n[edges[k + near] & 3];
    if (o >= 0) prefetch(&mesh.vertices[mesh.triangles[o >> 2].v[o & 3]]);
  }
}

/// Calls use(t, i) for the inner edges between two triangles t < u for which calls_for(t, u) is true when their batch
/// begins. In a batch, calls it for all edges after the first use(t, i) that returns true for a change. The result equals
/// the result of calls for all edges if use(t, i) ignores edges that need nothing.
template <typename CallsFor, typename Use>
void for_calling_edges(const Triangulation& mesh, Monitor& monitor, const CallsFor& calls_for, const Use& use) {
  std::vector<HalfEdge> calling, all;
  const auto total = static_cast<std::int32_t>(mesh.triangles.size());
  for (std::int32_t first = 0; first < total; first += triangles_at_once) {
    if (first % work_sizes::steps == 0) monitor.checkpoint();
    const std::int32_t end = std::min(total, first + triangles_at_once);
    list_calling_edges(mesh, first, end, calling, calls_for);
    if (calling.empty()) continue;
    list_edges(mesh, first, end, all);
    const std::vector<HalfEdge>* edges = &calling;
    for (std::size_t k = 0; k < edges->size(); ++k) {
      prefetch_beyond(mesh, *edges, k);
      const HalfEdge he = (*edges)[k];
      if (!use(he >> 2, he & 3) || edges == &all) continue;
      edges = &all;
      k = static_cast<std::size_t>(std::lower_bound(all.begin(), all.end(), he) - all.begin());
    }
  }
}

}  // namespace carreau::plane
