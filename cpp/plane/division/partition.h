// SPDX-License-Identifier: BSD-3-Clause
// Parts of a coarse mesh of about the same weight.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "control_space/control_space.h"
#include "metric/metric2.h"
#include "plane/division/coarse_domain.h"
#include "plane/division/options.h"
#include "plane/kernel/frame.h"
#include "support/monitor.h"

namespace carreau::plane {

/// A coarse mesh that is divided into parts.
struct CoarseMesh {
  PlaneMesh mesh;
  std::vector<std::array<std::int32_t, 3>> beyond;  ///< by triangle and side (opposite to its corner); -1: nothing
  std::vector<Metric2> metric;                      ///< by triangle: at its centroid, of edges of the coarse mesh
  std::vector<double> weight;                       ///< by triangle: unit triangles that it holds
};

/// The mesh of `domain` in `metric`, in which edges of `length` units are unit.
CoarseMesh make_coarse_mesh(const CoarseDomain& domain, const ControlSpace& metric, double length, Field::Known known,
                            const PlaneMesherOptions& options, Monitor& monitor);

/// For each triangle: its part, from 0. Parts are connected, and their borders are as short as the sides of the mesh's
/// triangles permit. Borders avoid degenerate sides and badly shaped triangles. There may be fewer parts than
/// requested.
struct Partition {
  std::vector<std::int32_t> part;
  int parts = 0;
};
Partition divide(const CoarseMesh& coarse, const CoarseDomain& domain, int parts, Monitor& monitor);

}  // namespace carreau::plane
