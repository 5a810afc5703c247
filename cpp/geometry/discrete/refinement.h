// SPDX-License-Identifier: BSD-3-Clause
// Triangles of a discrete surface, cut finer (HDR sec. 4.9.3).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "geometry/discrete/surface.h"
#include "mesh/periodic_link.h"
#include "support/monitor.h"

namespace carreau::discrete {

/// A finer mesh of the same surface. Each triangle lies on one patch.
struct RefinedMesh {
  std::vector<Vec3> vertices;  ///< the surface's vertices first
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> parent;              ///< of triangles: the triangle of the surface
  std::vector<std::array<Vec2, 3>> uv;           ///< of triangles: corners on their patch
  std::vector<std::vector<std::int32_t>> lines;  ///< vertices of each line of the surface, in its order
  bool complete = true;                          ///< false: the depth was reached before all criteria held
  std::vector<PeriodicLink> periodic = {};       ///< all pairs of its vertices; faces are known by references of flat_mesh()
};

struct RefinementLimits {
  int depth = 12;                      ///< rounds
  std::int64_t triangles = 100000000;  ///< LimitError beyond
};

/// Criteria for cutting a triangle into four, and for halving an edge (vertices and their places in `mesh`).
struct RefinementWish {
  std::function<bool(const RefinedMesh& mesh, std::size_t triangle)> triangle;
  std::function<bool(const RefinedMesh& mesh, std::int32_t v, std::int32_t w)> edge;
};

/// Cuts triangles by their edges until all criteria hold. With a criterion for triangles, a triangle with two halved
/// edges gets the third one halved, too (HDR sec. 4.9.3). With a criterion for edges alone, it becomes three. Throws
/// LimitError and Cancelled.
/// `periodic`: pairs of the surface's vertices. Images of cut edges are cut at the images of their middles.
RefinedMesh refine(const DiscreteSurface& surface, const RefinementWish& wish, const RefinementLimits& limits,
                   Monitor& monitor, std::vector<PeriodicLink> periodic = {});

/// Criterion that cuts a triangle in four if its normal is off the surface's normal at a corner by more than `angle`
/// degrees.
RefinementWish wish_of_angle(const DiscreteSurface& surface, double angle);

/// The mesh with face_refs(), sharp edges, whose references are the ranks of their lines, the references of
/// corners, and the pairs of faces, lines and corners.
FlatMesh flat_mesh(const DiscreteSurface& surface, const RefinedMesh& mesh);
/// The triangles themselves, the same way.
RefinedMesh unrefined(const DiscreteSurface& surface);

/// References of the faces of results, by triangle of the surface, positive. They are the references given to the
/// surface, else the references of the input when it has several, else ranks of regions, from 1.
std::vector<std::int32_t> face_refs(const DiscreteSurface& surface);

}  // namespace carreau::discrete
