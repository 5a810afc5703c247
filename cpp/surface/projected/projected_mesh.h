// SPDX-License-Identifier: BSD-3-Clause
// A first mesh of the wanted sizes, made in planes chart by chart.
#pragma once

#include <optional>
#include <span>

#include "surface/independent/independent.h"
#include "surface/independent/placed_mesh.h"

namespace carreau {

struct ProjectedOptions {
  int threads = 1;
  std::int64_t max_triangles = 0;
};

/// Of sizes without direction. None where the charts do not serve: it is then as if nobody had asked. The same for any
/// number of threads.
std::optional<PlacedMesh> make_projected_mesh(const RemeshingFrame& frame, const SurfaceMesh& before,
                                              std::span<const double> size, std::span<const WorkedLine> worked,
                                              const SurfaceTolerances& tolerances, const ProjectedOptions& options,
                                              Cad& cad, Monitor& monitor);

}  // namespace carreau
