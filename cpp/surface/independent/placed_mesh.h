// SPDX-License-Identifier: BSD-3-Clause
// A mesh over an atlas, from parametric remeshing.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/independent/line_remeshing.h"

namespace carreau {

/// Vertices of lines reuse as many numbers of these lines' vertices in the previous mesh as necessary; others follow.
struct PlacedMesh {
  std::vector<SurfacePlace> added;                ///< the vertices that follow
  std::vector<EditableMesh::Triangle> triangles;  ///< as the atlas is turned
  std::vector<std::vector<LineNode>> lines;       ///< by line
  std::vector<std::vector<KeptPlaces>> on_line;   ///< by line and node; none where a vertex stays where it was
  std::vector<std::int32_t> seams;                ///< vertices that nothing but the making has put in line
  std::vector<std::int32_t> kept;                 ///< corners of triangles that were in the previous mesh
};

}  // namespace carreau
