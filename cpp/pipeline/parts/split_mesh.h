// SPDX-License-Identifier: BSD-3-Clause
// The part of one process of a mesh that all processes have.
#pragma once

#include "mesh/flat_mesh.h"
#include "pipeline/parts/part_mesh.h"

namespace carreau {

/// The share of process `rank` of `whole`, with ghosts: consecutive elements, as many as each other process has. A vertex belongs to
/// the lowest process with an element at it, a vertex of no element to process 0. An edge belongs to the lowest process with an
/// element along it, else to process 0. Counts and numbers are set; quality, faces and edges of files are not.
PartMesh split_mesh(const FlatMesh& whole, int rank, int processes);

}  // namespace carreau
