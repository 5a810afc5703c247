// SPDX-License-Identifier: BSD-3-Clause
// Checks of every plane mesh, and its quality.
#pragma once

#include <string>
#include <vector>

#include "mesh/plane_mesh.h"
#include "plane_cases.h"

namespace carreau::testing {

/// Empty when `mesh` is a triangulation of `domain`. Imposed vertices come first and unmoved, and every triangle is
/// strictly counterclockwise (exactly). An edge is in one triangle if it is on the boundary and in two otherwise, once
/// in each direction. All imposed edges are present, no vertex is unused, and each vertex has one fan (on the boundary
/// a union of fans). Euler's number and the area agree with the domain.
std::vector<std::string> find_plane_defects(const PlaneDomain& domain, const PlaneMesh& mesh);

struct PlaneQuality {
  std::size_t triangles = 0, vertices = 0;
  double mean = 0, p1 = 0, worst = 1;                              ///< Q2 (HDR eq. 1.6) of the triangles in space
  double mean_length = 0, fitting = 0, shortest = 0, longest = 0;  ///< edge over size; share in [1/sqrt 2, sqrt 2]
  double degree_six = 0;                                           ///< share of the vertices that are not imposed
};
/// Triangles and edges that are one point or one line of space (on a degenerate side) are left out.
PlaneQuality measure(const PlaneCase& c, const PlaneMesh& mesh);
std::string to_string(const PlaneQuality& q);

}  // namespace carreau::testing
