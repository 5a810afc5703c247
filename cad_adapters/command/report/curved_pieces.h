// SPDX-License-Identifier: BSD-3-Clause
// Curved elements as the viewer of a report draws them: flat pieces of the triangles of the mesh.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "draw/view.h"
#include "files/mesh_file.h"
#include "report/triangle_values.h"

namespace command {

/// In the order of the triangles that they are of, each of which has some.
struct CurvedPieces {
  std::vector<Point> points;                         ///< numbered behind the vertices of the mesh
  std::vector<std::array<std::int32_t, 3>> corners;  ///< of vertices, and of points behind them
  std::vector<std::uint32_t> triangle;               ///< by piece: its triangle of the mesh
  /// By piece: bit k: its side from corner k to the next lies on a curve, bit 3 + k: it lies inside an element.
  std::vector<std::uint32_t> sides;
};

/// None where all elements are straight. Triangles that no element is known of are pieces themselves.
CurvedPieces curved_pieces(const MeshArrays& mesh, const std::vector<std::uint8_t>& halves);

}  // namespace command
