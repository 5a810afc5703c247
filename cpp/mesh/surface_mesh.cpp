#include "mesh/surface_mesh.h"

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

std::size_t SurfaceMesh::edge_count() const noexcept {
  std::size_t count = 0;
  for (const CurveMesh& curve : curves)
    if (!curve.vertices.empty()) count += curve.vertices.size() - 1;
  return count;
}

}  // namespace carreau
