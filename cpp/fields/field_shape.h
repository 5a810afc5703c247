// SPDX-License-Identifier: BSD-3-Clause
// The parameter domain of a face whose fields are sampled, also if the face could not be meshed.
#pragma once

#include <span>
#include <vector>

#include "cad/cad.h"
#include "fields/pixel_raster.h"
#include "mesh/plane_mesh.h"
#include "model/model.h"
#include "surface/supports.h"

namespace carreau {

struct FieldShape {
  PlaneSegments loops;  ///< closed, as DomainRaster requires
  PlaneSegments lines;  ///< all curves, internal ones too
  Vec2 low, high;       ///< box of the loops; both zero without loops
  double gap = 0;       ///< longest segment (parameter units) that was needed to close the loops
};

/// The domain that was meshed.
FieldShape shape_of(const PlaneDomain& domain);

/// The domain as the host's curves bound it. `supports`: the supports of the face's curves when they are known, else
/// empty. Then each curve is sampled at some hundred points, except where the host fails. Ends that do not meet are
/// joined, the nearest first: parity needs closed loops. Throws Cancelled.
FieldShape shape_of(const Face& face, std::span<const CurveSupport> supports, Cad& cad, Monitor& monitor);

}  // namespace carreau
