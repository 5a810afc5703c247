// SPDX-License-Identifier: BSD-3-Clause
#include "plane/division/undivided.h"

#include <algorithm>
#include <utility>

#include "plane/kernel/boundary.h"
#include "plane/optimise/delaunay_swaps.h"
#include "plane/optimise/local_search.h"
#include "plane/optimise/optimise.h"
#include "plane/placement/advancing_front.h"
#include "plane/placement/algebraic.h"
#include "plane/placement/degenerate_sides.h"
#include "plane/placement/squares.h"
#include "plane/placement/undersampled_regions.h"

namespace carreau::plane {

// The imposed vertices get the host's numbers back: the frame's numbers are equal, except the smallest.
PlaneMesh to_mesh(const PlaneDomain& domain, const Triangulation& triangulation, const Frame& frame) {
  PlaneMesh mesh;
  mesh.vertices.reserve(triangulation.vertices.size());
  for (const Vec2& p : domain.vertices) mesh.vertices.push_back(p);
  std::vector<std::int32_t> shifted;  // numbers of the vertices from the first one that was removed
  std::size_t first_removed = triangulation.vertices.size();
  for (std::size_t v = domain.vertices.size(); v < triangulation.vertices.size(); ++v) {
    const Vertex& P = triangulation.vertices[v];
    if (P.triangle < 0) first_removed = std::min(first_removed, v);
    if (v >= first_removed) shifted.push_back(static_cast<std::int32_t>(mesh.vertices.size()));
    if (P.triangle >= 0) mesh.vertices.push_back(frame.outward(P.point()));
  }
  mesh.triangles.reserve(triangulation.triangles.size());
  for (const Triangle& t : triangulation.triangles) {
    if (t.v[0] < 0) continue;
    mesh.triangles.push_back({t.v[0], t.v[1], t.v[2]});
    if (shifted.empty()) continue;
    for (std::int32_t& v : mesh.triangles.back())
      if (static_cast<std::size_t>(v) >= first_removed) v = shifted[static_cast<std::size_t>(v) - first_removed];
  }
  return mesh;
}

namespace {

void place_points(PlaneWork& work, const PlaneDomain& domain, const Frame& frame, const PlaneMesherOptions& options) {
  Placement placement(work, options.max_triangles);
  placement.resting = options.resting;
  // No later pass swaps edges of squares.
  if (options.squares && has_leaning_strips(work)) swap_to_delaunay(work);
  surround_degenerate_sides(placement, domain);
  work.fixed = static_cast<int>(work.mesh.vertices.size());
  if (options.squares) place_squares(placement);
  const auto fill = [&] { options.frontal ? advance_front(placement) : split_long_edges(placement); };
  if (!options.squares) fill();
  bool seeded = false;
  for (const std::vector<Vec2>& places : options.undersampled) {
    int hint = work.mesh.vertices.back().triangle;
    const auto seed = [&](Vec2 p) { return seed_region(placement, frame.inward(p), hint); };
    seeded = std::any_of(places.begin(), places.end(), seed) || seeded;
  }
  if (seeded) fill();
  placement.forget_touched();
}

}  // namespace

UndividedWork work_undivided(const PlaneDomain& domain, const ControlSpace& metric, Field::Known known,
                             const PlaneMesherOptions& options, Improve improve, Monitor& monitor) {
  BoundaryMesh boundary = triangulate_boundary(domain, monitor);
  const Field field(metric, boundary.frame, known);
  PlaneWork work{boundary.mesh, field, monitor};
  place_points(work, domain, boundary.frame, options);
  boundary.mesh.renumber_if_large();
  if (improve == Improve::yes) {
    if (options.squares) {
      mend_squares(work);
    } else {
      const Settled settled = optimise(work);
      if (options.shape_trials) search_around_bad_triangles(work, settled, options.normals);
    }
  }
  const int fixed = work.fixed;
  return {std::move(boundary), fixed};
}

namespace {

UndividedMesh mesh(const PlaneDomain& domain, const ControlSpace& metric, Field::Known known,
                   const PlaneMesherOptions& options, Improve improve, Monitor& monitor) {
  const UndividedWork work = work_undivided(domain, metric, known, options, improve, monitor);
  return {to_mesh(domain, work.framed.mesh, work.framed.frame), work.fixed};
}

}  // namespace

UndividedMesh mesh_undivided(const PlaneDomain& domain, const ControlSpace& metric, Field::Known known,
                             const PlaneMesherOptions& options, Monitor& monitor) {
  return mesh(domain, metric, known, options, Improve::yes, monitor);
}

UndividedMesh place_undivided(const PlaneDomain& domain, const ControlSpace& metric, Field::Known known,
                              const PlaneMesherOptions& options, Monitor& monitor) {
  return mesh(domain, metric, known, options, Improve::no, monitor);
}

}  // namespace carreau::plane
