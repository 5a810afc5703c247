// SPDX-License-Identifier: BSD-3-Clause
// A first mesh of the prescribed sizes by parametric remeshing, in one plane for each chart.
#pragma once

#include <optional>
#include <span>

#include "support/ranks/executor.h"
#include "surface/remesh/frame.h"

namespace carreau {

struct ProjectedOptions {
  Executor executor = {};  ///< distributes charts; the mesh does not depend on it
  std::int64_t max_triangles = 0;
};

/// Requires sizes without direction. Returns nothing, and changes nothing, if the charts are not suitable. All
/// processes of the communicator call it. Throws InvalidModel if their surfaces or sizes differ.
std::optional<PlacedMesh> make_projected_mesh(const RemeshingFrame& frame, const SurfaceMesh& before,
                                              std::span<const double> size, std::span<const WorkedLine> worked,
                                              const SurfaceTolerances& tolerances, const ProjectedOptions& options,
                                              Cad& cad, Monitor& monitor);

}  // namespace carreau
