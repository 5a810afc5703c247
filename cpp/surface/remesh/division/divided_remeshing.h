// SPDX-License-Identifier: BSD-3-Clause
// Large cross-patch meshes remeshed to the prescribed sizes in parts, by several threads and processes.
#pragma once

#include <cstdint>
#include <span>

#include "cad/cad.h"
#include "support/monitor.h"
#include "surface/remesh/base/cross_patch_mesh.h"
#include "surface/remesh/edits/remeshing.h"
#include "surface/options.h"

namespace carreau {

/// The threads and processes that remesh parts of a mesh. The mesh does not depend on it.
struct RemeshingWorkers : Executor {
  bool hosts_threads = false;  ///< several threads may call the host

  RemeshingWorkers() = default;
  RemeshingWorkers(const CompositeOptions& options, const Cad& cad)
      : Executor(options.executor), hosts_threads(asks_from_threads(options, cad)) {}
};

/// remesh(); in three rounds if there are enough triangles to remesh that cuts pay. The first round cuts the mesh into parts with a fixed
/// number of triangles and remeshes each part by itself. The second round remeshes the surroundings of the cuts, in parts again, and the
/// third round the surroundings of these new cuts. All processes of the communicator call it: throws InvalidModel if their meshes differ
/// before.
RemeshingReport remesh_divided(CrossPatchMesh& mesh, const RemeshingWorkers& workers, Monitor& monitor, bool everywhere, bool thorough,
                               std::span<const std::int32_t> around = {});

}  // namespace carreau
