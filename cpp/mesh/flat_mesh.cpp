// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/flat_mesh.h"

#include <utility>

namespace carreau {

namespace {

FlatFace flat_face(const FaceMesh& face) {
  return {.ref = face.shown_ref(), .status = face.status, .name = face.name, .why = face.why, .rgb = face.rgb};
}

/// Rank of a status in a whole face when its parts differ.
int weight(FaceStatus status) {
  switch (status) {
    case FaceStatus::failed:
      return 3;
    case FaceStatus::mended:
      return 2;
    case FaceStatus::meshed:
      return 1;
    default:
      return 0;
  }
}

}  // namespace

std::vector<WholeFace> whole_faces(const SurfaceMesh& mesh) {
  std::vector<WholeFace> all;
  for (const FaceMesh& face : mesh.faces) {
    if (face.status == FaceStatus::wire) continue;
    if (face.part_of == 0 || all.empty() || all.back().face.ref != face.part_of) {
      all.push_back({flat_face(face), face.triangles.size()});
      continue;
    }
    WholeFace& whole = all.back();
    whole.triangles += face.triangles.size();
    if (weight(face.status) > weight(whole.face.status)) whole.face.status = face.status, whole.face.why = face.why;
  }
  return all;
}

void add_cell(FlatMesh& mesh, const Cell& cell, std::int32_t ref) {
  const std::array<std::int32_t, 8>& n = cell.nodes;
  mesh.triangles.push_back({n[0], n[1], n[2]});
  if (corner_count(cell.kind) == 4) mesh.triangles.push_back({n[0], n[2], n[3]});
  mesh.triangle_refs.resize(mesh.triangles.size(), ref);
  mesh.cells.push_back(cell);
}

FlatMesh flatten(const SurfaceMesh& mesh, bool with_edges) {
  FlatMesh flat;
  flat.vertices = mesh.vertices;
  flat.vertex_refs = mesh.vertex_ref;
  flat.triangles.reserve(mesh.triangle_count());
  flat.triangle_refs.reserve(mesh.triangle_count());
  const bool of_cells = mesh.cells_are_not_triangles();
  flat.vertices.insert(flat.vertices.end(), mesh.mid_vertices.begin(), mesh.mid_vertices.end());
  flat.vertex_refs.resize(flat.vertices.size(), 0);
  for (const FaceMesh& face : mesh.faces) {
    if (of_cells)
      for (const Cell& cell : cells_of(mesh, face)) add_cell(flat, cell, face.shown_ref());
    else
      for (const auto& t : face.triangles)
        flat.triangles.push_back({face.vertex[t[0]], face.vertex[t[1]], face.vertex[t[2]]});
    flat.triangle_refs.resize(flat.triangles.size(), face.shown_ref());
  }
  for (WholeFace& whole : whole_faces(mesh)) flat.faces.push_back(std::move(whole.face));
  flat.edges.reserve(with_edges ? mesh.edge_count() : mesh.loose_edge_count());
  for (const CurveMesh& curve : mesh.curves) {
    if (!with_edges && !curve.loose) continue;
    for (std::size_t i = 1; i < curve.vertices.size(); ++i)
      flat.edges.push_back({curve.vertices[i - 1], curve.vertices[i]});
    for (const std::int32_t mid : curve.mid)
      flat.edge_mids.push_back(static_cast<std::int32_t>(mesh.vertices.size()) + mid);
    flat.edge_refs.resize(flat.edges.size(), curve.shown_ref());
  }
  flat.periodic = mesh.periodic;
  return flat;
}

}  // namespace carreau
