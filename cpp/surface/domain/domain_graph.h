// SPDX-License-Identifier: BSD-3-Clause
// Shared by the checks of a domain: the edges that meet at a vertex. Private to domain_*.cpp.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "mesh/plane_mesh.h"

namespace carreau {

/// Throws InvalidArgument when an edge refers to a vertex that does not exist or a coordinate is not finite.
void require_sound(const PlaneDomain& domain);

/// "(u, v) = (0.5, 1)".
std::string name_of_place(const Vec2& uv);

inline bool bounds(const PlaneEdge& edge) noexcept { return edge.kind != PlaneEdgeKind::internal; }

/// The ends of the boundary and degenerate edges, in their order.
std::vector<std::pair<int, int>> bounding_edges(const PlaneDomain& domain);

/// Returns 1 if the directed edges turn left about the mean of their first ends, once altogether, -1 if right, 0
/// otherwise. Edges that form loops and turn once are one loop that does not meet itself.
int turn_about_mean(const PlaneDomain& domain, std::span<const std::pair<int, int>> edges);

/// Returns whether the domain is one loop that turns left about its mean once, without internal edges and points. Sound
/// domains only. Most small ones are; no other check can find a fault of these.
bool is_star(const PlaneDomain& domain);

/// The edges at each vertex, in increasing order.
class DomainIncidence {
 public:
  enum class Which { all, bounding };
  DomainIncidence(const PlaneDomain& domain, Which which);
  [[nodiscard]] std::span<const int> at(int vertex) const noexcept {
    return {edge_.data() + first_[vertex], edge_.data() + first_[vertex + 1]};
  }

 private:
  std::vector<int> first_, edge_;
};

/// A path of edges that follow each other.
struct Chain {
  std::vector<int> edges;
  std::vector<char> against;  ///< whether edges[i] is run from b to a
  bool closed = false;        ///< the last edge ends where the first starts, and no other edge does there
};

/// Decomposes the edges of `incidence` into maximal paths through vertices at which exactly two edges meet and
/// `passes(vertex)` holds. Deterministic: chains start at their lowest edge when closed, else at an end.
std::vector<Chain> chains_of(const PlaneDomain& domain, const DomainIncidence& incidence, const std::vector<char>& passes);

}  // namespace carreau
