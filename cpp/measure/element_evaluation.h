// SPDX-License-Identifier: BSD-3-Clause
// Measures of elements other than straight triangles.
#pragma once

#include "measure/mesh_evaluation.h"

namespace carreau {

/// Replaces the values of straight triangles that represent such elements: A0 and A1 use the element's polynomial map, at
/// sample points of its (u, v), or, if it is of several charts, of its reference element. Both halves of a quadrilateral
/// receive its values: its shape and its scaled Jacobian (mesh/elements/cell_quality.h) in place of Q1 and Q2, and its shape
/// in the metric of its middle in place of the metric quality. Its diagonal has no length, angle or gradation (NaN). Does not
/// change measures of straight triangles. Throws the exceptions of callbacks, and Cancelled.
void evaluate_elements(const SurfaceMesh& mesh, Cad& cad, const PrescribedMetric& prescribed, const SpreadAtlas& atlas,
                       Monitor& monitor, MeshEvaluation& delivered);

}  // namespace carreau
