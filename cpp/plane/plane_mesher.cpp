#include "plane/plane_mesher.h"

#include <string>

#include "plane/constraints.h"
#include "plane/fans.h"
#include "plane/filler.h"
#include "plane/optimiser.h"

namespace carreau {

namespace {

constexpr int sweeps = 3;

PlaneMesh to_mesh(const plane::Triangulation& triangulation) {
  PlaneMesh mesh;
  mesh.vertices.reserve(triangulation.vertices.size());
  for (const plane::Vertex& v : triangulation.vertices) mesh.vertices.push_back(v.point());
  mesh.triangles.reserve(triangulation.triangles.size());
  for (const plane::Triangle& t : triangulation.triangles) mesh.triangles.push_back({t.v[0], t.v[1], t.v[2]});
  return mesh;
}

}  // namespace

PlaneMesh mesh_plane(const PlaneDomain& domain, const ControlSpace& metric, const PlaneMesherOptions& options,
                     Monitor& monitor) {
  const PlaneDomain with_rings = plane::with_fans(domain, metric);
  plane::Triangulation triangulation = plane::triangulate(with_rings, monitor);
  for (plane::Vertex& v : triangulation.vertices) {
    const Metric2 m = metric.at(v.point());
    v.a = static_cast<float>(m.a), v.b = static_cast<float>(m.b), v.c = static_cast<float>(m.c);
  }
  plane::Filler filler(triangulation, metric, options.max_triangles, monitor);
  if (options.frontal)
    filler.march();
  else
    filler.split_long_edges();
  plane::Optimiser(triangulation, static_cast<int>(with_rings.vertices.size()), metric, monitor).run(sweeps);
  return to_mesh(triangulation);
}

PlaneMesh triangulate_domain(const PlaneDomain& domain, Monitor& monitor) {
  return to_mesh(plane::triangulate(domain, monitor));
}

}  // namespace carreau
