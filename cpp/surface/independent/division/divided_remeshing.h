// SPDX-License-Identifier: BSD-3-Clause
// Large free meshes made as they are wanted in parts, by several threads and processes.
#pragma once

#include <cstdint>
#include <span>

#include "cad/cad.h"
#include "support/monitor.h"
#include "surface/independent/base/free_mesh.h"
#include "surface/independent/edits/remeshing.h"
#include "surface/options.h"

namespace carreau {

/// Who works at parts of a mesh. The mesh does not depend on it.
struct RemeshingWorkers {
  Team* team = nullptr;       ///< processes; null: this one alone
  int threads = 1;
  bool hosts_threads = false; ///< the host may be asked by several threads

  RemeshingWorkers() = default;
  RemeshingWorkers(const CompositeOptions& options, const Cad& cad)
      : team(options.team), threads(options.threads), hosts_threads(asks_from_threads(options, cad)) {}
};

/// remesh(); where as many triangles are to be worked at as pay the cuts, in three rounds. The mesh is cut into parts of a fixed number of them, each of which
/// is remeshed by itself; then what is near the cuts, in parts again; then what is near the cuts of those. All processes of a team call it: throws
/// InvalidModel where their meshes differ before.
RemeshingReport remesh_divided(FreeMesh& mesh, const RemeshingWorkers& workers, Monitor& monitor, bool everywhere, bool thorough,
                               std::span<const std::int32_t> around = {});

}  // namespace carreau
