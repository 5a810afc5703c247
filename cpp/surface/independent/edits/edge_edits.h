// SPDX-License-Identifier: BSD-3-Clause
// Edits of single edges: their results, and the edits that pay.
#pragma once

#include <cstdint>
#include <optional>

#include "surface/independent/base/free_mesh.h"

namespace carreau {

/// Edges at v whose lengths are out of range.
[[nodiscard]] int out_of_range(const FreeMesh& mesh, std::int32_t v);

/// Returns whether a swap of the edge from a to b to c and d brings the vertices nearer to six edges.
[[nodiscard]] bool evens_degrees(const FreeMesh& mesh, std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d);
/// Returns whether a swap would make a diagonal that is too long.
[[nodiscard]] bool is_too_long(const FreeMesh& mesh, std::int32_t v, std::int32_t w, std::int32_t c, std::int32_t d);
/// Swaps if the surface agrees and the worst shape gains, or, for degrees, shapes stay good enough; otherwise returns false and changes
/// nothing.
bool swap_edge(FreeMesh& mesh, const FreeMesh::Quad& q, bool for_degrees = false);

/// Puts a vertex on the surface over the middle of an edge, where lengths gain, shapes stay fair and the surface agrees.
std::optional<std::int32_t> split_edge(FreeMesh& mesh, const FreeMesh::Quad& q);
/// Splits an edge of any length.
std::optional<std::int32_t> halve_edge(FreeMesh& mesh, const FreeMesh::Quad& q);

/// The shapes after a collapse.
struct CollapseShapes {
  double worst = -1;  ///< shape; negative: it may not be
  double cost = 0;    ///< ShapeBudget
};
/// Shapes after the collapse of a short edge.
[[nodiscard]] CollapseShapes shapes_when_short(const FreeMesh& mesh, std::int32_t gone, std::int32_t kept);
/// Shapes after the collapse of an edge that is not short, among small triangles.
[[nodiscard]] CollapseShapes shapes_when_dense(const FreeMesh& mesh, std::int32_t gone, std::int32_t kept);
/// Returns whether triangles around an edge stay, in the mean, no larger than prescribed without two of them.
[[nodiscard]] bool is_dense(const FreeMesh& mesh, std::int32_t v, std::int32_t w);
/// Collapses the edge if the surface agrees; otherwise returns false and changes nothing.
bool collapse_edge(FreeMesh& mesh, std::int32_t gone, std::int32_t kept);

}  // namespace carreau
