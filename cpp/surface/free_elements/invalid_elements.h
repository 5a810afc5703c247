// SPDX-License-Identifier: BSD-3-Clause
// What stays invalid in a mesh that is free of patches, and what is to be finer for it.
#pragma once

#include <compare>
#include <cstddef>
#include <vector>

#include "gradation/edge_sizes.h"
#include "surface/options.h"
#include "surface/result.h"

namespace carreau {

/// An edge on a curve of the host: as in the cad_m routines, with the parameters of its ends.
struct CoarseEdge {
  int face = 0, ic = 0;
  double from = 0, to = 0;
  friend auto operator<=>(const CoarseEdge&, const CoarseEdge&) = default;
};

struct InvalidInSpace {
  std::size_t count = 0;
  std::vector<CoarseEdge> coarse;  ///< sides of such elements on curves
  /// By face: their sides, with half of the longest one, or of what was wanted there, as the size (the whole of it where all elements
  /// are cut).
  std::vector<std::vector<EdgeSizes::Source>> finer;
};

/// Elements whose Jacobian is not positive everywhere.
[[nodiscard]] InvalidInSpace find_invalid(const SizedMesh& made, Element element);

/// Says so in their faces, which are `mended`.
void tell_invalid(SurfaceMesh& mesh);

/// Faces with an edge between wrong joints (find_wrong_joints) become `failed`, with a place of such a joint, and lose their elements.
void fail_wrong_joints(SizedMesh& made);

/// The same where an edge or a triangle at a vertex of a curve is joined wrongly, and faces without a triangle; other edges
/// are not looked at. Faces whose curves meet in more vertices than they should are joined so. Vertices that are lost with
/// faces are dropped. False: nothing has failed.
bool fail_unsound_faces(SizedMesh& made);

}  // namespace carreau
