#include "mesh/flat_mesh.h"

#include <utility>

namespace carreau {

namespace {

FlatFace flat_face(const FaceMesh& face) {
  return {.ref = face.shown_ref(), .status = face.status, .name = face.name, .why = face.why, .rgb = face.rgb};
}

/// How much a status says of a whole face when parts of it differ.
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

FlatMesh flatten(const SurfaceMesh& mesh, bool with_edges) {
  FlatMesh flat;
  flat.vertices = mesh.vertices;
  flat.vertex_refs = mesh.vertex_ref;
  flat.triangles.reserve(mesh.triangle_count());
  flat.triangle_refs.reserve(mesh.triangle_count());
  for (const FaceMesh& face : mesh.faces) {
    for (const auto& t : face.triangles)
      flat.triangles.push_back({face.vertex[t[0]], face.vertex[t[1]], face.vertex[t[2]]});
    flat.triangle_refs.resize(flat.triangles.size(), face.shown_ref());
  }
  for (WholeFace& whole : whole_faces(mesh)) flat.faces.push_back(std::move(whole.face));
  if (!with_edges) return flat;
  flat.edges.reserve(mesh.edge_count());
  for (const CurveMesh& curve : mesh.curves) {
    for (std::size_t i = 1; i < curve.vertices.size(); ++i)
      flat.edges.push_back({curve.vertices[i - 1], curve.vertices[i]});
    flat.edge_refs.resize(flat.edges.size(), curve.shown_ref());
  }
  return flat;
}

}  // namespace carreau
