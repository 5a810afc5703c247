// SPDX-License-Identifier: BSD-3-Clause
// Cells of VTK, as its files number their types.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/solid_skin.h"
#include "mesh/flat_mesh.h"

namespace carreau {

struct HighOrderMesh;

/// Gathers cells one after the other, and gives them to a mesh: points of the file are its vertices.
class VtkCells {
 public:
  /// From now on Lagrange cells of order 3 and 4 go to a mesh, without references: mixed orders are errors.
  void set_curved(HighOrderMesh& curved) noexcept { curved_ = &curved; }
  /// The cells of its edges (2 corners), triangles (3) and quadrilaterals (4).
  [[nodiscard]] const std::vector<std::size_t>& cell_of_curved(int corners) const noexcept { return cell_of_curved_[corners - 2]; }
  /// Returns a part of a sentence when the cell cannot be taken, else "". Points and polyhedra are skipped. Triangles and
  /// quadrilaterals of order 1 and 2 are taken, pixels, polygons and strips cut; solids are kept for their outer faces.
  /// `vertices`: of all points.
  std::string add(std::int64_t type, std::span<const std::int32_t> corners, std::size_t cell,
                  const std::vector<Vec3>& vertices);
  /// Moves edges and elements into the mesh, without references; of solids without a surface their outer faces.
  void give_to(FlatMesh& mesh);

  /// After give_to(): the cell of each triangle and edge.
  [[nodiscard]] const std::vector<std::size_t>& cell_of_triangle() const noexcept { return cell_of_triangle_; }
  [[nodiscard]] const std::vector<std::size_t>& cell_of_edge() const noexcept { return cell_of_edge_; }

 private:
  bool add_curved_cell(std::int64_t type, std::span<const std::int32_t> nodes, std::size_t cell);
  bool add_surface(std::int64_t type, std::span<const std::int32_t> corners, std::size_t cell,
                   const std::vector<Vec3>& vertices);
  bool add_solid(std::int64_t type, std::span<const std::int32_t> corners, std::size_t cell);
  bool add_edges(std::int64_t type, std::span<const std::int32_t> corners, std::size_t cell);
  void add_element(CellKind kind, std::span<const std::int32_t> nodes, std::size_t cell);
  bool add_polygon(std::span<const std::int32_t> corners, std::size_t cell, const std::vector<Vec3>& vertices);

  struct Element {
    Cell cell;
    std::size_t rank;  ///< of the cell in the file
  };

  std::vector<Element> elements_;
  HighOrderMesh* curved_ = nullptr;
  std::vector<std::size_t> cell_of_curved_[3];
  std::string wrong_;  // of curved cells
  std::vector<std::array<std::int32_t, 2>> edges_;
  std::vector<std::int32_t> edge_mids_;
  std::vector<std::array<std::int32_t, 4>> tetrahedra_;
  SolidSkin skin_;
  std::vector<std::size_t> cell_of_solid_, cell_of_triangle_, cell_of_edge_;
};

}  // namespace carreau
