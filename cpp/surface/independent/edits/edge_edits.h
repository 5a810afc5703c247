// SPDX-License-Identifier: BSD-3-Clause
// Edits of single edges: what they would leave, and those that are worth it.
#pragma once

#include <cstdint>
#include <optional>

#include "surface/independent/edits/judgement.h"

namespace carreau {

/// Towards six edges at each vertex: whether the edge from a to b had better lead from c to d.
[[nodiscard]] bool evens_degrees(const FreeMesh& mesh, std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d);
/// A swap must not make what is too long.
[[nodiscard]] bool is_too_long(const FreeMesh& mesh, std::int32_t v, std::int32_t w, std::int32_t c, std::int32_t d);
/// Swaps where the worst shape gains, or, where degrees do, shapes stay good enough, and the surface agrees; else false, and
/// nothing is changed.
bool swap_edge(FreeMesh& mesh, const FreeMesh::Quad& q, bool for_degrees = false);

/// Puts a vertex on the surface over the middle of an edge, where lengths gain, shapes stay fair and the surface agrees.
std::optional<std::int32_t> split_edge(FreeMesh& mesh, const FreeMesh::Quad& q);
/// The same whatever the length of the edge.
std::optional<std::int32_t> halve_edge(FreeMesh& mesh, const FreeMesh::Quad& q);

/// What a collapse leaves.
struct CollapseShapes {
  double worst = -1;  ///< shape; negative: it may not be
  double cost = 0;    ///< ShapeBudget
};
/// Of a short edge; `dense`: triangles are small, though the edge is not short.
[[nodiscard]] CollapseShapes shapes_after_collapse(const FreeMesh& mesh, std::int32_t gone, std::int32_t kept, bool dense);
/// Whether triangles around an edge stay no larger than wanted, in the mean, without two of them.
[[nodiscard]] bool is_dense(const FreeMesh& mesh, std::int32_t v, std::int32_t w);
/// Collapses where the surface agrees; else false, and nothing is changed.
bool collapse_edge(FreeMesh& mesh, std::int32_t gone, std::int32_t kept);

}  // namespace carreau
