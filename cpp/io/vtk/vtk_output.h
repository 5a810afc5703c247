// SPDX-License-Identifier: BSD-3-Clause
// Elements and edges of a mesh as both of VTK's formats list them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/flat_mesh.h"

namespace carreau {

/// The cells of a file: elements, so that the number of an element is the number of its cell, then the edges of curves.
/// The mesh must live as long.
class VtkOutput {
 public:
  explicit VtkOutput(const FlatMesh& mesh);

  [[nodiscard]] const FlatMesh& mesh() const noexcept { return mesh_; }
  [[nodiscard]] std::size_t elements() const noexcept { return first_.size(); }
  [[nodiscard]] std::size_t size() const noexcept { return first_.size() + mesh_.edges.size(); }
  [[nodiscard]] std::uint8_t type(std::size_t cell) const noexcept;
  [[nodiscard]] std::int32_t ref(std::size_t cell) const noexcept;
  /// Appends the nodes of a cell, whose order is VTK's already.
  void append_nodes(std::size_t cell, std::vector<std::int32_t>& nodes) const;
  /// Returns the values of a field of triangles or edges for all cells: for a quadrilateral the mean of its halves, NaN
  /// for cells without a value.
  [[nodiscard]] std::vector<double> values(const MeshField& field) const;

 private:
  const FlatMesh& mesh_;
  std::vector<std::int32_t> first_;  ///< the first triangle of each element
};

}  // namespace carreau
