// SPDX-License-Identifier: BSD-3-Clause
// Edges of curves against their curves.
#pragma once

#include "measure/mesh_evaluation.h"

namespace carreau {

/// Fills curve_deviation and curve_angle: NaN inside faces, and if EvaluationOptions::curve_parameters does not know
/// the place of an end. Throws the exceptions of callbacks, and Cancelled.
void evaluate_curves(const SurfaceMesh& mesh, Cad& cad, std::span<const CurveParameters> parameters, Monitor& monitor,
                     MeshEvaluation& delivered);

}  // namespace carreau
