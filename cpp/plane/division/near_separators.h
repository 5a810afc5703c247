// SPDX-License-Identifier: BSD-3-Clause
// Layers of a piece beside its separators.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/plane_mesh.h"
#include "plane/division/pieces.h"
#include "plane/kernel/triangulation.h"
#include "support/monitor.h"

namespace carreau::plane {

/// The part of a piece's mesh near separators.
struct NearSeparators {
  std::vector<std::int32_t> vertices;   ///< vertices less than zone_layers layers away
  std::vector<std::int32_t> level;      ///< by these: layers from the separators
  std::vector<std::int32_t> band;       ///< by these: the separator, or Pieces::several
  std::vector<std::int32_t> triangles;  ///< triangles with one of these vertices, ascending
};

/// `mesh`: the triangulation of the piece, which `result` was made from. `separator`: see Pieces.
NearSeparators near_separators(const Piece& piece, const std::vector<std::int32_t>& separator,
                               const Triangulation& mesh, const PlaneMesh& result, Monitor& monitor);

}  // namespace carreau::plane
