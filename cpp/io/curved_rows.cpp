// SPDX-License-Identifier: BSD-3-Clause
#include "io/curved_rows.h"

#include <algorithm>
#include <array>

namespace carreau {

bool add_curved(HighOrderMesh& mesh, int order, int corners, std::span<const std::int32_t> nodes, std::int32_t ref) {
  const bool first = mesh.triangle_refs.empty() && mesh.quad_refs.empty() && mesh.edge_refs.empty();
  if (!first && order != mesh.order) return false;
  mesh.order = order;
  std::vector<std::int32_t>& rows = corners == 2 ? mesh.edges : corners == 3 ? mesh.triangles : mesh.quads;
  rows.insert(rows.end(), nodes.begin(), nodes.end());
  (corners == 2 ? mesh.edge_refs : corners == 3 ? mesh.triangle_refs : mesh.quad_refs).push_back(ref);
  return true;
}

std::vector<std::size_t> vtk_ranks_of_quad(int order) {
  const std::vector<std::array<int, 2>> gmsh = node_indices(true, order);
  std::vector<std::array<int, 2>> vtk(gmsh.begin(), gmsh.begin() + 4);
  for (int i = 1; i < order; ++i) vtk.push_back({i, 0});
  for (int i = 1; i < order; ++i) vtk.push_back({order, i});
  for (int i = 1; i < order; ++i) vtk.push_back({i, order});
  for (int i = 1; i < order; ++i) vtk.push_back({0, i});
  for (int k = 1; k < order; ++k)
    for (int i = 1; i < order; ++i) vtk.push_back({i, k});
  std::vector<std::size_t> rank;
  for (const auto& index : vtk) rank.push_back(static_cast<std::size_t>(std::find(gmsh.begin(), gmsh.end(), index) - gmsh.begin()));
  return rank;
}

std::vector<std::size_t> mfem_ranks(bool quad, int order) {
  const std::vector<std::array<int, 2>> gmsh = node_indices(quad, order);
  std::vector<std::size_t> rank;
  for (int k = 0; k <= order; ++k)
    for (int i = 0; i <= (quad ? order : order - k); ++i)
      rank.push_back(static_cast<std::size_t>(std::find(gmsh.begin(), gmsh.end(), std::array<int, 2>{i, k}) - gmsh.begin()));
  return rank;
}

}  // namespace carreau
