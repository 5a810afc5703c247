// SPDX-License-Identifier: BSD-3-Clause
// Checks that processes agree, and that their hosts give the same answers.
#pragma once

#include <cstdint>

#include "mesh/surface_mesh.h"
#include "pipeline/base/run.h"
#include "support/ranks/team.h"

namespace carreau {

/// The minimum over the processes: machines differ in memory, and the mesh must not depend on the machine.
[[nodiscard]] std::int64_t least_of(Team& team, std::int64_t max_triangles);

/// Throws Error, which names process and curve, if a process has cut a curve differently from the first process: its
/// callbacks or parameters differ.
void require_same_curves(Team& team, const CompositeRun& run);

/// Throws Error if the hosts' answers differ at a few vertices of each patch: positions and prescribed sizes.
void require_same_surfaces(Team& team, const CompositeRun& run);

/// Throws Error if the processes sampled a face that all make together differently: its pieces would not fit together.
void require_same_samples(Team& team, int face, const ControlSpace& space);

/// Throws Error if the assembled meshes differ: every process makes the steps after the patches, from answers of its
/// own host.
void require_same_mesh(Team& team, const SurfaceMesh& mesh);

}  // namespace carreau
