// SPDX-License-Identifier: BSD-3-Clause
// Options of the plane mesher.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "control_space/sampled_normals.h"
#include "support/ranks/executor.h"
#include "support/vec.h"

namespace carreau {

struct PlaneMesherOptions {
  bool frontal = true;        ///< false: algebraic placement, points on edges longer than unity (RT-0232 `frontal`)
  bool squares = false;       ///< points for quadrilaterals, on lattices of unit squares; ignores `frontal`
  bool shape_trials = false;  ///< changes of the mesh around its worst triangles are tried, the best is kept
  /// Normals of a curved surface, indexed. Changes leave no edges along which it turns more than along the edges
  /// before, and add no edges between two vertices of curves. Null: a plane.
  const SampledNormals* normals = nullptr;
  std::int64_t max_triangles = INT64_C(500'000'000);  ///< LimitError beyond
  /// Squares that another mesh has missed (ControlSpace::undersampled_regions()), each as its places. After the
  /// placement, places still far from all vertices receive a seed, from which the front continues.
  std::span<const std::vector<Vec2>> undersampled = {};
  /// For each vertex of the domain, or empty: layers do not start from an edge with a nonzero end.
  std::span<const std::uint8_t> resting = {};
  Executor executor = {};  ///< at work on a large domain: all processes call the mesher. The mesh does not depend on it
};

}  // namespace carreau
