// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/surface_mesh.h"

#include <algorithm>

namespace carreau {

std::size_t SurfaceMesh::triangle_count() const noexcept {
  std::size_t count = 0;
  for (const FaceMesh& face : faces) count += face.triangles.size();
  return count;
}

std::size_t SurfaceMesh::cell_count() const noexcept {
  std::size_t count = 0;
  for (const FaceMesh& face : faces) count += face.cell_count();
  return count;
}

bool SurfaceMesh::cells_are_not_triangles() const noexcept {
  return !mid_vertices.empty() ||
         std::any_of(faces.begin(), faces.end(), [](const FaceMesh& face) { return face.quads > 0; });
}

std::size_t SurfaceMesh::loose_edge_count() const noexcept {
  std::size_t count = 0;
  for (const CurveMesh& curve : curves)
    if (curve.loose && !curve.vertices.empty()) count += curve.vertices.size() - 1;
  return count;
}

std::size_t SurfaceMesh::edge_count() const noexcept {
  std::size_t count = 0;
  for (const CurveMesh& curve : curves)
    if (!curve.vertices.empty()) count += curve.vertices.size() - 1;
  return count;
}

}  // namespace carreau
