// SPDX-License-Identifier: BSD-3-Clause
// What elements other than straight triangles deliver.
#pragma once

#include "measure/mesh_evaluation.h"

namespace carreau {

/// Replaces what was measured on straight triangles where they stand for such elements: A0 and A1 are those of the
/// surface from the element's own polynomial map, at sample points of its (u, v), or, where it is of several charts, of its
/// own. Of a quadrilateral both halves get its
/// values, its shape and its scaled Jacobian (mesh/elements/cell_quality.h) in place of Q1 and Q2, and its shape in the metric
/// of its middle in place of the metric quality; its diagonal has no length, angle or gradation (NaN). Nothing is done
/// to meshes of straight triangles. Throws what callbacks throw, and Cancelled.
void evaluate_elements(const SurfaceMesh& mesh, Cad& cad, const PrescribedMetric& prescribed, const SpreadAtlas& atlas,
                       Monitor& monitor, MeshEvaluation& delivered);

}  // namespace carreau
