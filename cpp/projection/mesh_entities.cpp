// SPDX-License-Identifier: BSD-3-Clause
#include "projection/mesh_entities.h"

#include "support/infinity.h"

namespace carreau {

std::vector<MeshEntity> entities_of_nodes(const SurfaceMesh& mesh, const std::function<std::size_t(std::size_t, std::int32_t)>& uv_face,
                                          std::span<const CurveParameters> curves) {
  const std::size_t corners = mesh.vertices.size();
  std::vector<MeshEntity> entities(corners + mesh.mid_vertices.size());
  const auto put_on_face = [&](std::size_t node, std::size_t face, std::int32_t local) {
    if (entities[node].ref == 0) entities[node].ref = mesh.faces[uv_face(face, local)].ref;
  };
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const FaceMesh& face = mesh.faces[f];
    for (std::size_t k = 0; k < face.vertex.size(); ++k) put_on_face(static_cast<std::size_t>(face.vertex[k]), f, static_cast<std::int32_t>(k));
    for (std::size_t k = 0; k < face.mid_vertex.size(); ++k)
      put_on_face(corners + static_cast<std::size_t>(face.mid_vertex[k]), f, static_cast<std::int32_t>(face.uv.size() + k));
  }
  NodesOfCurves nodes(entities.size());
  for (std::size_t c = 0; c < mesh.curves.size(); ++c) {
    const CurveMesh& curve = mesh.curves[c];
    const auto put_on_curve = [&](std::size_t node, double t) {
      if (nodes.takes(node, entities[node], t)) entities[node] = {1, curve.ref};
    };
    const bool known = c < curves.size() && curves[c].t.size() == curve.vertices.size();
    for (std::size_t k = 0; k < curve.vertices.size(); ++k) put_on_curve(static_cast<std::size_t>(curve.vertices[k]), known ? curves[c].t[k] : nan);
    for (const std::int32_t mid : curve.mid)
      if (mid >= 0) put_on_curve(corners + static_cast<std::size_t>(mid), nan);
  }
  for (std::size_t v = 0; v < corners && v < mesh.vertex_ref.size(); ++v)
    if (mesh.vertex_ref[v] != 0) entities[v] = {0, mesh.vertex_ref[v]};
  return entities;
}

}  // namespace carreau
