// SPDX-License-Identifier: BSD-3-Clause
#include "measure/bounds/bounded_triangles.h"

#include <algorithm>
#include <cmath>

namespace carreau {

BoundedTriangles::BoundedTriangles(const SurfaceMesh& mesh, const MeshEdges& edges) : mesh_(mesh), edges_(edges) {
  vertices_.reserve(edges.of_triangle.size());
  for (const FaceMesh& face : mesh.faces)
    for (const auto& t : face.triangles) vertices_.push_back({face.vertex[t[0]], face.vertex[t[1]], face.vertex[t[2]]});
  std::vector<std::int32_t> triangles_of(edges.vertices.size(), 0);
  for (const auto& sides : edges.of_triangle)
    for (const std::int32_t e : sides) ++triangles_of[e];
  open_edge_.assign(edges.vertices.size(), 0);
  open_vertex_.assign(mesh.vertices.size(), 0);
  for (std::size_t e = 0; e < open_edge_.size(); ++e) {
    if (edges.segment[e] < 0 && triangles_of[e] == 2) continue;
    open_edge_[e] = 1;
    for (const std::int32_t v : edges.vertices[e]) open_vertex_[v] = 1;
  }
  normal_.reserve(vertices_.size()), height_.reserve(vertices_.size());
  for (std::size_t t = 0; t < vertices_.size(); ++t) {
    const auto [a, b, c] = corners(t);
    const Vec3 n = cross(b - a, c - a);
    const double area = norm(n), longest = std::max({norm(b - a), norm(c - b), norm(a - c)});
    normal_.emplace_back(area > 0 ? Vec3(n / area) : Vec3(0, 0, 0));
    height_.push_back(longest > 0 ? area / longest : 0);
  }
  around_.emplace(mesh.vertices.size(), vertices_);
}

std::array<Vec3, 3> BoundedTriangles::corners(std::size_t triangle) const {
  const auto& [a, b, c] = vertices_[triangle];
  return {mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c]};
}

BoundedTriangle BoundedTriangles::at(std::size_t triangle) const {
  BoundedTriangle made(corners(triangle));
  double least = 1;  // cosine
  made.reach = height_[triangle];
  for (std::size_t i = 0; i < 3; ++i) {
    made.open_side[i] = open_edge_[edges_.of_triangle[triangle][i]] != 0;
    made.open_corner[i] = open_vertex_[vertices_[triangle][i]] != 0;
    for (const std::int32_t t : around_->of(vertices_[triangle][i])) {
      least = std::min(least, dot(normal_[t], normal_[triangle]));
      made.reach = std::min(made.reach, height_[t]);
    }
  }
  made.slope = least > 0.5 ? std::sqrt(std::max(0.0, 1 - least * least)) / least : infinity;
  return made;
}

}  // namespace carreau
