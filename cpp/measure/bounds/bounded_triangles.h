// SPDX-License-Identifier: BSD-3-Clause
// The triangles of a mesh, each with its neighbourhood.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "measure/base/mesh_edges.h"
#include "mesh/surface_mesh.h"
#include "support/incidence.h"
#include "surface/remesh/bounds/triangle_bound.h"

namespace carreau {

/// Keeps references to its arguments.
class BoundedTriangles {
 public:
  BoundedTriangles(const SurfaceMesh& mesh, const MeshEdges& edges);

  [[nodiscard]] std::size_t size() const noexcept { return vertices_.size(); }
  [[nodiscard]] const std::array<std::int32_t, 3>& vertices(std::size_t triangle) const { return vertices_[triangle]; }
  /// Without the floors.
  [[nodiscard]] BoundedTriangle at(std::size_t triangle) const;

 private:
  [[nodiscard]] std::array<Vec3, 3> corners(std::size_t triangle) const;

  const SurfaceMesh& mesh_;
  const MeshEdges& edges_;
  std::vector<std::array<std::int32_t, 3>> vertices_;
  std::vector<char> open_edge_, open_vertex_;  // the mesh ends there, or a curve is there
  std::vector<Vec3> normal_;                   // of unit length
  std::vector<double> height_;                 // the smallest one
  std::optional<Incidence> around_;
};

}  // namespace carreau
