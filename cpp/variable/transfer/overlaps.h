// SPDX-License-Identifier: BSD-3-Clause
// Areas that the triangles of two meshes of the plane have in common.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/triangle_search.h"
#include "variable/base/piece.h"

namespace carreau::variable {

/// Row i lists the common parts of triangle i of the new mesh and triangles of the old mesh, these ascending.
struct Overlaps {
  struct Entry {
    std::int32_t old = 0;
    double area = 0;
    Vec2 centre;  ///< of the part in common
  };
  std::vector<std::size_t> start;  ///< of rows, and the end
  std::vector<Entry> entries;
};

/// `search` holds the triangles of `old`. Triangles are counterclockwise.
Overlaps overlaps_of(const Piece& old, const TriangleSearch& search, const Piece& piece);

/// The intersection of two counterclockwise triangles: its area and its centre (`old` is 0).
Overlaps::Entry common_part(const std::array<Vec2, 3>& p, const std::array<Vec2, 3>& q) noexcept;

}  // namespace carreau::variable
