// SPDX-License-Identifier: BSD-3-Clause
// Who keeps what of a mesh in parts. Private to surface/.
#pragma once

#include <string>
#include <vector>

#include "pipeline/base/run.h"

namespace carreau {

/// Throws InvalidArgument where the options want something that needs the whole mesh. Before anything is made.
void refuse_parts(const CompositeOptions& options, const SizeRules& rules);

/// The same where narrow faces are to vanish: before a face is meshed.
void refuse_narrow_parts(const NarrowModel& narrow);

/// What each process says of its own faces reaches all: `of_face` is "" for faces of others before.
void share_sentences(Team& team, std::vector<std::string>& of_face);

/// The shares of all processes, after assemble(): numbers are those that one process gives. All processes call it.
MeshShares share_out(const CompositeRun& run);

/// Numbers in the whole mesh of the vertices that this process has, those on curves first, then those of its faces.
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

/// By vertex of curves: the least rank that keeps a face of one of its curves; 0 for vertices of no face.
std::vector<int> owners_on_curves(const SurfaceMesh& mesh, const MeshShares& shares);

}  // namespace carreau
