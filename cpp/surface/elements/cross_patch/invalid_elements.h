// SPDX-License-Identifier: BSD-3-Clause
// Elements that stay invalid in a mesh that is free of patches, and refinements that may repair them.
#pragma once

#include <compare>
#include <cstddef>
#include <vector>

#include "gradation/edge_sizes.h"
#include "support/monitor.h"
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
  /// The sides of these elements, by face, with a size for each. The size is half of the longest side or of the prescribed size, whichever
  /// is smaller (without halving if all elements are cut).
  std::vector<std::vector<EdgeSizes::Source>> finer;
};

/// Elements whose Jacobian is not positive everywhere.
[[nodiscard]] InvalidInSpace find_invalid(const SizedMesh& made, Element element);

/// Reports invalid elements in their faces, which become `mended`.
void tell_invalid(SurfaceMesh& mesh);
/// Reports the invalid elements of one face of the mesh.
void tell_invalid(const SurfaceMesh& mesh, FaceMesh& face);

/// Faces with an edge between wrong joints (find_wrong_joints) become `failed`, with a place of such a joint, and lose their elements.
void fail_wrong_joints(SizedMesh& made);

/// Fails faces without a triangle, and faces with an edge or a triangle that is joined wrongly at a vertex of a curve. Other edges are not
/// looked at. Faces whose curves meet in more vertices than they should are joined so. Vertices that are lost with faces are dropped.
/// False: nothing has failed.
bool fail_unsound_faces(SizedMesh& made, int threads, Monitor& monitor);

}  // namespace carreau
