// SPDX-License-Identifier: BSD-3-Clause
#include "surface/discrete/beside_patches.h"

#include <utility>

#include "support/infinity.h"
#include "surface/discrete/discrete_run.h"

namespace carreau {

namespace {

void moved(std::vector<std::int32_t>& vertices, std::int32_t by) {
  for (std::int32_t& v : vertices) v += by;
}

/// Gives a mesh of patches the arrays of a cross-patch mesh, whose borders have no meaning.
void keep_charts(SurfaceMesh& mesh) {
  if (mesh.independent) return;
  mesh.independent = true;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    mesh.faces[f].uv_face.assign(mesh.faces[f].uv.size(), static_cast<std::int32_t>(f));
    mesh.faces[f].spread.assign(mesh.faces[f].triangles.size(), 0);
  }
}

void append_faces(const SurfaceMesh& from, SurfaceMesh& mesh) {
  const auto vertices = static_cast<std::int32_t>(mesh.vertices.size()),
             mids = static_cast<std::int32_t>(mesh.mid_vertices.size());
  for (std::size_t f = 0; f < from.faces.size(); ++f) {
    if (from.faces[f].status == FaceStatus::not_meshed) continue;
    FaceMesh& face = mesh.faces[f] = from.faces[f];
    moved(face.vertex, vertices), moved(face.mid_vertex, mids);
  }
}

void append_curves(const SurfaceMesh& from, int behind, SurfaceMesh& mesh) {
  const auto vertices = static_cast<std::int32_t>(mesh.vertices.size()),
             mids = static_cast<std::int32_t>(mesh.mid_vertices.size());
  for (CurveMesh curve : from.curves) {
    curve.ref += behind;
    moved(curve.vertices, vertices), moved(curve.mid, mids);
    mesh.curves.push_back(std::move(curve));
  }
}

void append_places(const SurfaceMesh& from, int behind, SurfaceMesh& mesh) {
  mesh.vertices.insert(mesh.vertices.end(), from.vertices.begin(), from.vertices.end());
  mesh.mid_vertices.insert(mesh.mid_vertices.end(), from.mid_vertices.begin(), from.mid_vertices.end());
  for (const std::int32_t ref : from.vertex_ref) mesh.vertex_ref.push_back(ref > 0 ? ref + behind : ref);
}

CompositeReport sum_of(CompositeReport report, const CompositeReport& triangles) {
  report.calls = triangles.calls;  // counted on
  report.crossings = -1;
  report.seconds_total += triangles.seconds_total;
  return report;
}

Model triangles_of(const Model& model) {
  Model part = model;
  for (Face& face : part.faces)
    if (!face.discrete) face.left_out = "not given by triangles", face.curves.clear(), face.points.clear();
  return part;
}

}  // namespace

void leave_out_triangles(Model& model) {
  for (Face& face : model.faces)
    if (face.discrete) face.left_out = "given by triangles";
}

double diagonal_with(const ModelSupports& supports, const discrete::DiscreteCad& triangles) {
  Vec3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  const auto enclose = [&](const std::vector<Vec3>& points) {
    for (const Vec3& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  };
  enclose(triangles.discrete().mesh().vertices);
  for (const auto& face : supports.of_face)
    for (const CurveSupport& support : face) enclose(support.xyz);
  return norm(high - low);
}

std::shared_ptr<const PartResults> mesh_beside(CompositeResult patches, const Model& model,
                                               const discrete::DiscreteCad& triangles, Cad& cad,
                                               CompositeOptions options, Monitor& monitor) {
  auto both = std::make_shared<PartResults>();
  both->patches = std::move(patches);
  both->triangle_options = std::move(options);
  both->triangles = mesh_discrete(triangles_of(model), triangles, cad, both->triangle_options, monitor);
  both->triangle_options.executor = both->triangle_options.executor.alone();  // the mesh outlives it
  return both;
}

CompositeResult beside_each_other(const CompositeResult& patches, const CompositeResult& triangles,
                                  const LargestReferences& largest) {
  CompositeResult both;
  both.mesh = patches.mesh;
  keep_charts(both.mesh);
  append_faces(triangles.mesh, both.mesh);
  append_curves(triangles.mesh, largest.curve, both.mesh);
  append_places(triangles.mesh, largest.point, both.mesh);
  both.vertex_size = patches.vertex_size;
  both.vertex_size.insert(both.vertex_size.end(), triangles.vertex_size.begin(), triangles.vertex_size.end());
  both.curve_size = patches.curve_size;
  both.curve_size.resize(patches.mesh.curves.size());
  both.curve_size.insert(both.curve_size.end(), triangles.curve_size.begin(), triangles.curve_size.end());
  both.gaps = patches.gaps;
  both.report = sum_of(patches.report, triangles.report);
  return both;
}

}  // namespace carreau
