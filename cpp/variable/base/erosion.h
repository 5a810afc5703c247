// SPDX-License-Identifier: BSD-3-Clause
// Imposed deformation: totally damaged elements go (HDR sec. 3.4.2).
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "variable/base/piece.h"

namespace carreau::variable {

/// The remaining piece.
struct Eroded {
  Piece piece;                            ///< vertices that no triangle has are gone
  std::vector<std::int32_t> vertex_of;    ///< of each vertex: its index before
  std::vector<std::int32_t> triangle_of;  ///< of each triangle: its index before
  Adjacency adjacency;
  std::vector<std::array<bool, 3>> bared;  ///< sides of triangles that elements were removed from
  std::vector<std::array<bool, 3>> imposed;  ///< sides that elements were removed from in earlier increments
  std::int64_t damaged = 0;                ///< triangles removed because of their damage
  std::int64_t at_multiple_vertices = 0;   ///< removed because more than two boundary edges met at a vertex
  std::int64_t dangling = 0;               ///< removed because one side only still held them
  std::int64_t in_parts = 0;               ///< removed with smaller parts
  double removed_area = 0;
  std::int32_t parts_found = 0, parts_kept = 0;
};

/// Removes the triangles whose damage reaches `limit` (none if `damage` is empty). Then, while boundary vertices are
/// multiple, removes the triangles at them. Then removes triangles left with one neighbour only (ours: as spikes they
/// would get thinner and thinner), and all parts but the largest, unless `keep_all_parts`. Throws InvalidArgument if
/// the piece becomes empty, and the exceptions of adjacency_of. `kinds` (enum Kind) of the vertices: a side of the boundary between two
/// imposed vertices stays imposed; empty: none does.
Eroded erode(const Piece& piece, std::span<const double> damage, double limit, bool keep_all_parts,
             std::span<const std::int32_t> kinds = {});

}  // namespace carreau::variable
