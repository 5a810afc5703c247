// SPDX-License-Identifier: BSD-3-Clause
// Shapes of quadrilaterals that a refinement keeps.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cad/cad.h"
#include "mesh/surface_mesh.h"
#include "support/monitor.h"

namespace carreau::refining {

/// Moves vertices of elements whose shape is below `kept`, worst first, on the surface, where the worst element around is best: the search
/// that ends the meshing of quadrilaterals (WorstQuads). Turned elements are untangled in (u, v) before. Vertices before
/// `first_new` move only if the others do not suffice. `fixed`: by local vertex; `kept`: by triangle of the face. `isotropic`: shapes
/// in space count; else only turned elements. Does not evaluate the host if no element is worse.
void restore_quads(FaceMesh& face, std::vector<Vec3>& vertices, Cad& cad, bool isotropic, std::vector<char> fixed, std::span<const double> kept,
                   std::int32_t first_new, Monitor& monitor);

/// Elements that are turned, in (u, v) or in space.
struct TurnedElements {
  std::size_t count = 0;
  std::int32_t first = -1;  ///< a corner of the first one, in the mesh
};
TurnedElements find_turned(const FaceMesh& face, const std::vector<Vec3>& vertices);

}  // namespace carreau::refining
