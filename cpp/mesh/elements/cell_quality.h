// SPDX-License-Identifier: BSD-3-Clause
// Shapes of elements of any kind.
#pragma once

#include <cstddef>
#include <span>

#include "mesh/flat_mesh.h"
#include "mesh/quality.h"

namespace carreau {

/// The quality of one element.
struct CellQuality {
  /// sigma of the regular polygon over sigma = h / rho (HDR sec. 1.1.1). h is the diameter of the polygon of the
  /// corners, rho the least inradius of the triangles of two sides that meet. 1 for a square (sigma = 2 + 2 sqrt 2) and
  /// an equilateral triangle (2 sqrt 3).
  double shape = 0;
  /// Least sine of the angles at its corners, over the sine of the regular polygon; negative if a corner is turned
  /// over.
  double scaled_jacobian = 0;
  double least_jacobian = 0;           ///< Jacobian::least(): positive for a valid element
  double angle_min = 0, angle_max = 0;  ///< degrees, between the tangents of its sides; above 180 if turned over
  double area = 0;                      ///< of the curved element
};

/// `nodes`: node_count(kind) positions.
CellQuality cell_quality(CellKind kind, std::span<const Vec3> nodes) noexcept;

struct CellSummary {
  std::size_t triangles3 = 0, triangles6 = 0, quads4 = 0, quads8 = 0;
  Distribution shape, scaled_jacobian, least_jacobian;
  double angle_min_deg = 0, angle_max_deg = 0;
  double area = 0;            ///< of the curved elements
  double triangle_share = 0;  ///< share of triangles in the area
  std::size_t invalid = 0;    ///< elements whose least Jacobian is not positive
};
CellSummary summarise_cells(const FlatMesh& mesh);

/// The elements of a mesh, its triangles if FlatMesh::cells is empty: use(index, cell, nodes, first triangle).
template <typename Use>
void for_cells(const FlatMesh& mesh, const Use& use) {
  std::array<Vec3, 8> nodes;
  const std::size_t count = mesh.cells.empty() ? mesh.triangles.size() : mesh.cells.size();
  for (std::size_t c = 0, t = 0; c < count; ++c) {
    Cell cell;
    if (mesh.cells.empty())
      for (std::size_t i = 0; i < 3; ++i) cell.nodes[i] = mesh.triangles[c][i];
    else
      cell = mesh.cells[c];
    const auto n = static_cast<std::size_t>(node_count(cell.kind));
    for (std::size_t i = 0; i < n; ++i) nodes[i] = mesh.vertices[cell.nodes[i]];
    use(c, cell, std::span<const Vec3>(nodes.data(), n), t);
    t += corner_count(cell.kind) == 4 ? 2 : 1;
  }
}

}  // namespace carreau
