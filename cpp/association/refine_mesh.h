// SPDX-License-Identifier: BSD-3-Clause
// Finer meshes on known surfaces: edges are halved where they lie.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "curve/curve_model.h"
#include "size/size_rules.h"
#include "support/monitor.h"
#include "surface/options.h"
#include "surface/result.h"

namespace carreau {

/// The edges to halve; all members count.
struct RefineRequest {
  int halvings = 0;                                       ///< times that all edges are halved, after the other members
  std::vector<std::array<std::int32_t, 2>> edges = {};    ///< by vertices
  std::vector<std::int64_t> elements = {};                ///< all edges of these, by rank in the mesh
  std::vector<double> sizes = {};                         ///< at vertices: edges longer than sqrt(2) of the size, again and again; empty: none
};

/// Halves edges of `result.mesh`. New vertices lie on curves at the middle of the length, on faces at the place of the way in (u, v) that is as far
/// from both ends, or at the node of an element of second order. A triangle with two halved edges or fewer loses its longest edge too, and
/// edges of straight triangles around new vertices are swapped where shapes gain. A quadrilateral of four halved edges becomes four, else
/// triangles. Elements of second order get new nodes, and are repaired. Periodic faces are divided alike: slaves take the images of
/// their masters. Throws InvalidArgument for marks that the mesh does not have, LimitError, and the exceptions of the geometry.
void refine_mesh(const CurveModel& model, const SizeRules& rules, const CompositeOptions& options, const RefineRequest& request, Monitor& monitor,
                 CompositeResult& result);

}  // namespace carreau
