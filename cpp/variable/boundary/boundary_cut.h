// SPDX-License-Identifier: BSD-3-Clause
// The boundary is cut again, into edges of unit length (HDR sec. 3.4.4).
#pragma once

#include <vector>

#include "mesh/plane_mesh.h"
#include "variable/base/size_map.h"
#include "variable/boundary/boundary_sizes.h"

namespace carreau::variable {

/// The new boundary. Vertices and edges are from `domain`, kinds are of enum Kind.
struct CutBoundary {
  PlaneDomain domain;
  std::vector<std::int32_t> vertex_kinds, edge_kinds;
  std::vector<double> edge_sizes;  ///< prescribed at the middle of each edge
};

/// Cuts each run into n edges of normalised length L / n, L = sum of int ds / h (eq. 3.9) and n by the relative error
/// (eq. 2.14). The tools' sharp corners are vertices. Curves that keep their nodes keep their edges, too. New vertices
/// that lie inside a tool go to its surface, and are bound.
CutBoundary cut_boundary(const std::vector<BoundaryShape>& shapes, const Tools& tools, const SizeMap& sizes);

}  // namespace carreau::variable
