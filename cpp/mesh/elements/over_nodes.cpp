// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/elements/over_nodes.h"

#include <utility>

namespace carreau {

namespace {

using Triangles = std::vector<std::array<std::int32_t, 3>>;

void add_over_nodes(const Cell& cell, Triangles& triangles) {
  const std::array<std::int32_t, 8>& n = cell.nodes;
  const int corners = corner_count(cell.kind);
  if (!is_quadratic(cell.kind)) {
    triangles.push_back({n[0], n[1], n[2]});
    if (corners == 4) triangles.push_back({n[0], n[2], n[3]});
    return;
  }
  const auto mid = [&](int side) { return n[static_cast<std::size_t>(corners + side % corners)]; };
  for (int i = 0; i < corners; ++i) triangles.push_back({n[static_cast<std::size_t>(i)], mid(i), mid(i + corners - 1)});
  triangles.push_back({mid(0), mid(1), mid(2)});
  if (corners == 4) triangles.push_back({mid(0), mid(2), mid(3)});
}

void straighten(FaceMesh& face, std::int32_t vertices) {
  Triangles triangles;
  for (const Cell& cell : local_cells(face)) add_over_nodes(cell, triangles);
  face.triangles = std::move(triangles);
  face.uv.insert(face.uv.end(), face.mid_uv.begin(), face.mid_uv.end());
  for (const std::int32_t node : face.mid_vertex) face.vertex.push_back(vertices + node);
  face.quads = 0;
  face.mid.clear(), face.mid_uv.clear(), face.mid_vertex.clear();
}

void straighten(CurveMesh& curve, std::int32_t vertices) {
  std::vector<std::int32_t> all;
  for (std::size_t k = 0; k < curve.vertices.size(); ++k) {
    all.push_back(curve.vertices[k]);
    if (k < curve.mid.size()) all.push_back(vertices + curve.mid[k]);
  }
  curve.vertices = std::move(all);
  curve.mid.clear();
}

}  // namespace

SurfaceMesh straight_over_nodes(const SurfaceMesh& mesh) {
  SurfaceMesh straight = mesh;
  if (mesh.mid_vertices.empty()) return straight;
  const auto vertices = static_cast<std::int32_t>(mesh.vertices.size());
  for (FaceMesh& face : straight.faces) straighten(face, vertices);
  for (CurveMesh& curve : straight.curves) straighten(curve, vertices);
  straight.vertices.insert(straight.vertices.end(), mesh.mid_vertices.begin(), mesh.mid_vertices.end());
  straight.vertex_ref.resize(straight.vertices.size(), 0);
  straight.mid_vertices.clear();
  return straight;
}

FlatMesh straight_over_nodes(FlatMesh mesh) {
  if (!mesh.is_quadratic()) return mesh;
  Triangles triangles;
  std::vector<std::int32_t> refs;
  std::size_t t = 0;  // first triangle of the element
  for (const Cell& cell : mesh.cells) {
    add_over_nodes(cell, triangles);
    refs.resize(triangles.size(), mesh.triangle_refs[t]);
    t += corner_count(cell.kind) == 4 ? 2 : 1;
  }
  mesh.triangles = std::move(triangles), mesh.triangle_refs = std::move(refs);
  mesh.cells.clear();
  std::vector<std::array<std::int32_t, 2>> edges;
  std::vector<std::int32_t> edge_refs;
  for (std::size_t e = 0; e < mesh.edge_mids.size(); ++e) {
    edges.push_back({mesh.edges[e][0], mesh.edge_mids[e]}), edges.push_back({mesh.edge_mids[e], mesh.edges[e][1]});
    edge_refs.insert(edge_refs.end(), 2, mesh.edge_refs[e]);
  }
  if (!mesh.edge_mids.empty()) mesh.edges = std::move(edges), mesh.edge_refs = std::move(edge_refs);
  mesh.edge_mids.clear();
  mesh.fields.clear();
  return mesh;
}

}  // namespace carreau
