// SPDX-License-Identifier: BSD-3-Clause
// Distributes faces to the processes of a team. Private to pipeline/.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "pipeline/base/run.h"
#include "pipeline/faces/face_job.h"
#include "support/ranks/team.h"

namespace carreau {

/// The faces to mesh, with their order; equal in all processes.
struct DealtFaces {
  Team& team;
  std::span<std::unique_ptr<SteppedTask>> jobs;  ///< FaceJob; one that this process has meshed is null afterwards
  std::vector<std::size_t> shared;               ///< indices of jobs that all processes make together, ascending
  std::vector<std::size_t> order;                ///< the other jobs, longest first
  std::vector<double> expected;                  ///< triangles, by job, judged by boundaries
  double least_shared = 0;                       ///< triangles of a face that all make together
  int threads = 1;
  bool parts = false;  ///< patches stay with the process that meshed them; the processes own the patches that all made together in turn
  /// Called from the thread that runs when job `i` is begun, the `begun`-th of all processes.
  std::function<void(std::size_t i, std::size_t begun)> on_begun;
  /// Called for 0, 1, 2, ... in every process, with equal outcomes; if patches stay, in one of them with the patch.
  std::function<void(std::size_t i, FaceOutcome)> on_finished;
};

/// First the faces that all make together. Then each process takes a face whenever one of its threads is free, and at the end all exchange
/// the outcomes. A process puts a face off if its samples require more than its share of triangles; all processes mesh it together at the
/// end. All processes throw the error of the first face in order, after the outcomes before it. An error without a face (a stop, no memory)
/// comes first, as does an error of a face made together. Messages of faces reach all hosts, in order of the faces.
void mesh_dealt(const DealtFaces& faces, Monitor& monitor);

}  // namespace carreau
