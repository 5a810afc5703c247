// SPDX-License-Identifier: BSD-3-Clause
// Narrow faces that are the thickness of a body.
#pragma once

#include <vector>

#include "surface/narrow/narrow_faces.h"

namespace carreau {

/// Leaves faces out of the lists if their collapse would remove a body. These are strips whose two neighbours lie back
/// to back: beside the rim of a plate, along a wire or on the floor of a groove. Faces near a point that have such
/// neighbours only are left out too. Fillets, chamfers and steps remain: the surface goes on from one neighbour to the
/// other. Costs some normals a strip.
void keep_thin_bodies(const CurveModel& model, const std::vector<DiscreteCurve>& curves, NarrowModel& narrow);

}  // namespace carreau
