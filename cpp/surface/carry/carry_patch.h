// SPDX-License-Identifier: BSD-3-Clause
// The mesh of a slave face: the image of its master's mesh, on the slave's own surface.
#pragma once

#include <string>
#include <vector>

#include "gradation/edge_sizes.h"
#include "mesh/surface_mesh.h"
#include "surface/carry/domain_map.h"
#include "surface/patch.h"

namespace carreau {

struct CarriedPatch {
  bool flipped = false;  ///< triangles run the other way round: corners a, c, b of the slave are images of a, b, c
  PatchMesh mesh;       ///< triangle k is the image of the master's triangle k
  std::string failure;  ///< why the image is no mesh of the slave; empty: it is
  std::vector<EdgeSizes::Source> finer = {};  ///< what finer triangles of the master may mend
};

/// The triangle of a slave that is the image of triangle t of its master `from`. Halves of quadrilaterals change places where
/// they run the other way round.
inline std::size_t image_triangle(const FaceMesh& from, std::size_t t, bool flipped) noexcept {
  return flipped && t < 2 * static_cast<std::size_t>(from.quads) ? t ^ 1U : t;
}

/// Moves the image of each vertex to the closest point of the slave's surface, from guesses by the boundary or from
/// neighbours, and checks that no triangle is turned over in (u, v).
/// `curves` bound both domains. `gap`: how far (model length) images may miss the surface.
CarriedPatch carry_patch(const CurveModel& model, const std::vector<DiscreteCurve>& curves, const FacePair& pair,
                         const FaceDomain& master, const FaceDomain& slave, const PatchMesh& mesh, double gap);

}  // namespace carreau
