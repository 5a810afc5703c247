// SPDX-License-Identifier: BSD-3-Clause
// The edges of a mesh that a round of refinement halves.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "association/mesh_edges.h"

namespace carreau::refining {

/// All edges of a mesh, in space, and whether each is marked. Keeps a reference to the mesh, which stays as it is.
class EdgeMarks {
 public:
  explicit EdgeMarks(const SurfaceMesh& mesh);

  [[nodiscard]] const EdgeList& edges() const noexcept { return edges_; }
  [[nodiscard]] bool has(std::int32_t edge) const { return marked_[edge] != 0; }
  /// Between two vertices that have an edge.
  [[nodiscard]] bool has(std::int32_t a, std::int32_t b) const { return has(edges_.find(a, b)); }
  [[nodiscard]] std::int64_t count() const;

  void mark_all();
  /// Throws InvalidArgument if two vertices have no edge.
  void mark_edges(std::span<const Key> edges);
  /// All edges of elements, by rank in the mesh. Throws InvalidArgument if there is no such element.
  void mark_elements(std::vector<std::int64_t> elements);
  /// Edges longer than sqrt(2) of the size at their ends. Returns whether there is one.
  bool mark_long(std::span<const double> sizes);
  /// Marks the longest edge of each triangle that has a marked edge (Rivara 1984): angles stay bounded. Each edge is looked at once.
  void close();

 private:
  [[nodiscard]] double length(std::int32_t edge) const;

  const SurfaceMesh& mesh_;
  EdgeList edges_;
  std::vector<char> marked_;
};

}  // namespace carreau::refining
