// SPDX-License-Identifier: BSD-3-Clause
// Shapes and lengths of a mesh in parts. Private to pipeline/parts.
#pragma once

#include "mesh/quality.h"
#include "support/ranks/team.h"
#include "surface/result.h"

namespace carreau {

/// summarise_quality() of the whole mesh, in all processes, which all call it. Extremes, percentiles and counts equal the ones of a run
/// of one process; sums are added up in a different order.
QualitySummary summarise_parts(Team& team, const SurfaceMesh& mesh, const MeshShares& shares, int threads);

}  // namespace carreau
