#include "mesh/flat_mesh.h"

namespace carreau {

FlatFace flat_face(const FaceMesh& face) {
  return {.ref = face.ref, .status = face.status, .name = face.name, .why = face.why, .rgb = face.rgb};
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
    flat.triangle_refs.resize(flat.triangles.size(), face.ref);
    flat.faces.push_back(flat_face(face));
  }
  if (!with_edges) return flat;
  flat.edges.reserve(mesh.edge_count());
  for (const CurveMesh& curve : mesh.curves) {
    for (std::size_t i = 1; i < curve.vertices.size(); ++i)
      flat.edges.push_back({curve.vertices[i - 1], curve.vertices[i]});
    flat.edge_refs.resize(flat.edges.size(), curve.ref);
  }
  return flat;
}

}  // namespace carreau
