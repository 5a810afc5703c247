// SPDX-License-Identifier: BSD-3-Clause
// Processes that keep the faces and vertices of a mesh in parts. Private to pipeline/.
#pragma once

#include <string>
#include <vector>

#include "pipeline/base/run.h"

namespace carreau {

/// Throws InvalidArgument if an option requires the whole mesh. Callers check before they mesh.
void refuse_parts(const CompositeOptions& options, const SizeRules& rules, const LayerCurves& layers);

/// Rejects narrow faces that are to vanish, before a face is meshed.
void refuse_narrow_parts(const NarrowModel& narrow);

/// Sends the sentences on each process's own faces to all. Before, `of_face` is "" for faces of other processes.
void share_sentences(Team& team, std::vector<std::string>& of_face);

/// The shares of all processes, after assemble(); the numbers equal the numbers of a run of one process. All processes
/// call it.
MeshShares share_out(const CompositeRun& run);

/// Numbers in the whole mesh of the vertices that this process has: vertices on curves first, then vertices of its faces.
class PartVertices {
 public:
  explicit PartVertices(const MeshShares& shares);
  [[nodiscard]] std::int64_t in_mesh(std::int32_t vertex) const;

 private:
  struct Run {
    std::int64_t here, in_mesh;  // of the first vertex of a face
  };
  std::vector<Run> runs_;  // ascending
};

/// The least rank that keeps a face of one of the curves of a vertex, by vertex of curves; 0 for vertices of no face.
std::vector<int> owners_on_curves(const SurfaceMesh& mesh, const MeshShares& shares);

}  // namespace carreau
