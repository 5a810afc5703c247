// SPDX-License-Identifier: BSD-3-Clause
// A first mesh of the wanted sizes, made in planes chart by chart.
#pragma once

#include <optional>
#include <span>

#include "support/ranks/crew.h"
#include "surface/independent/frame.h"

namespace carreau {

struct ProjectedOptions {
  Crew crew = {};  ///< deals out charts; the mesh does not depend on it
  std::int64_t max_triangles = 0;
};

/// Of sizes without direction. None where the charts do not serve: it is then as if nobody had asked. All processes of a
/// team call it: throws InvalidModel where their surfaces or sizes differ.
std::optional<PlacedMesh> make_projected_mesh(const RemeshingFrame& frame, const SurfaceMesh& before,
                                              std::span<const double> size, std::span<const WorkedLine> worked,
                                              const SurfaceTolerances& tolerances, const ProjectedOptions& options,
                                              Cad& cad, Monitor& monitor);

}  // namespace carreau
