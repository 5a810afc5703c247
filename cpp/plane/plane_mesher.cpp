#include "plane/plane_mesher.h"

#include "plane/boundary.h"
#include "plane/filler.h"
#include "plane/optimiser.h"

namespace carreau {

namespace {

// The imposed vertices get the host's own numbers back: the frame's are equal, but for the smallest.
PlaneMesh to_mesh(const PlaneDomain& domain, const plane::Triangulation& triangulation, const plane::Frame& frame) {
  PlaneMesh mesh;
  mesh.vertices.reserve(triangulation.vertices.size());
  for (const Vec2 p : domain.vertices) mesh.vertices.push_back(p);
  for (std::size_t v = domain.vertices.size(); v < triangulation.vertices.size(); ++v)
    mesh.vertices.push_back(frame.outward(triangulation.vertices[v].point()));
  mesh.triangles.reserve(triangulation.triangles.size());
  for (const plane::Triangle& t : triangulation.triangles) mesh.triangles.push_back({t.v[0], t.v[1], t.v[2]});
  return mesh;
}

}  // namespace

PlaneMesh mesh_plane(const PlaneDomain& domain, const ControlSpace& metric, const PlaneMesherOptions& options,
                     Monitor& monitor) {
  plane::BoundaryMesh boundary = plane::triangulate_boundary(domain, monitor);
  const plane::Field field(metric, boundary.frame);
  int fixed = 0;
  {
    plane::Filler filler(boundary.mesh, field, options.max_triangles, monitor);
    fixed = filler.surround_degenerate_edges(domain);
    if (options.frontal)
      filler.march();
    else
      filler.split_long_edges();
  }
  boundary.mesh.renumber_if_large();
  plane::Optimiser(boundary.mesh, fixed, field, monitor).run();
  return to_mesh(domain, boundary.mesh, boundary.frame);
}

PlaneMesh triangulate_domain(const PlaneDomain& domain, Monitor& monitor) {
  const plane::BoundaryMesh boundary = plane::triangulate_boundary(domain, monitor);
  return to_mesh(domain, boundary.mesh, boundary.frame);
}

}  // namespace carreau
