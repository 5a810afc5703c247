// SPDX-License-Identifier: BSD-3-Clause
#include "plane/plane_mesher.h"

#include <utility>

#include "plane/division/divided_mesh.h"
#include "plane/division/undivided.h"
#include "plane/kernel/boundary.h"

namespace carreau {

PlaneMesh mesh_plane(const PlaneDomain& domain, const ControlSpace& metric, const PlaneMesherOptions& options,
                     Monitor& monitor) {
  const plane::Field::Known known{.bends = options.frontal && plane::Field::may_bend(metric),
                                  .triangles = metric.measure()};
  if (plane::is_worth_dividing(known, options))
    if (auto mesh = plane::mesh_divided(domain, metric, known, options, monitor)) return std::move(*mesh);
  return plane::mesh_undivided(domain, metric, known, options, monitor).mesh;
}

PlaneMesh triangulate_domain(const PlaneDomain& domain, Monitor& monitor) {
  const plane::BoundaryMesh boundary = plane::triangulate_boundary(domain, monitor);
  return plane::to_mesh(domain, boundary.mesh, boundary.frame);
}

}  // namespace carreau
