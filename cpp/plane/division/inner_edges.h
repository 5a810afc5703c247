// SPDX-License-Identifier: BSD-3-Clause
// The imposed edges of a domain that are no simple boundary, by their ends.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "mesh/plane_mesh.h"

namespace carreau::plane {

/// Internal edges and degenerate sides.
class InnerEdges {
 public:
  explicit InnerEdges(const PlaneDomain& domain) {
    for (const PlaneEdge& edge : domain.edges)
      if (edge.kind != PlaneEdgeKind::boundary) edges_.push_back({key(edge.a, edge.b), edge.kind});
    std::sort(edges_.begin(), edges_.end(), [](const Edge& e, const Edge& f) { return e.key < f.key; });
  }
  /// The kind of the edge between two vertices of the domain; PlaneEdgeKind::boundary: no inner edge.
  [[nodiscard]] PlaneEdgeKind kind(std::int32_t a, std::int32_t b) const noexcept {
    const std::int64_t wanted = key(a, b);
    const auto found =
        std::lower_bound(edges_.begin(), edges_.end(), wanted, [](const Edge& e, std::int64_t k) { return e.key < k; });
    return found != edges_.end() && found->key == wanted ? found->kind : PlaneEdgeKind::boundary;
  }

 private:
  struct Edge {
    std::int64_t key;
    PlaneEdgeKind kind;
  };
  static std::int64_t key(std::int64_t a, std::int64_t b) noexcept { return std::min(a, b) << 32 | std::max(a, b); }

  std::vector<Edge> edges_;  // by ascending keys
};

}  // namespace carreau::plane
