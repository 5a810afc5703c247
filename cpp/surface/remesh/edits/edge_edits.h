// SPDX-License-Identifier: BSD-3-Clause
// Edits of single edges: their results, and the edits that pay.
#pragma once

#include <cstdint>
#include <optional>

#include "surface/remesh/edits/judgement.h"

namespace carreau {

/// Returns whether a swap of the edge from a to b to c and d brings the vertices nearer to six edges.
[[nodiscard]] bool evens_degrees(const CrossPatchMesh& mesh, std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d);
/// Swaps if the surface agrees and the worst shape gains, or, for degrees, shapes stay good enough; otherwise returns false and changes
/// nothing.
bool swap_edge(CrossPatchMesh& mesh, const CrossPatchMesh::Quad& q, bool for_degrees = false);

/// Puts a vertex on the surface over the middle of an edge, where lengths gain, shapes stay fair and the surface agrees.
std::optional<std::int32_t> split_edge(CrossPatchMesh& mesh, const CrossPatchMesh::Quad& q);
/// Splits an edge of any length.
std::optional<std::int32_t> halve_edge(CrossPatchMesh& mesh, const CrossPatchMesh::Quad& q);

/// The shapes after a collapse.
struct CollapseShapes {
  double worst = -1;  ///< shape; negative: it may not be
  double cost = 0;    ///< ShapeBudget
};
/// Shapes after the collapse of a short edge, or, if `dense`, of an edge among small triangles.
[[nodiscard]] CollapseShapes shapes_after_collapse(const CrossPatchMesh& mesh, std::int32_t gone, std::int32_t kept, bool dense);
/// Returns whether triangles around an edge stay, in the mean, no larger than prescribed without two of them.
[[nodiscard]] bool is_dense(const CrossPatchMesh& mesh, std::int32_t v, std::int32_t w);
/// Collapses the edge if the surface agrees; otherwise returns false and changes nothing.
bool collapse_edge(CrossPatchMesh& mesh, std::int32_t gone, std::int32_t kept);

}  // namespace carreau
