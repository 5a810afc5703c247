// SPDX-License-Identifier: BSD-3-Clause
// Compares the mesh of a run with its prescriptions.
#pragma once

#include "measure/mesh_evaluation.h"
#include "surface/options.h"
#include "surface/result.h"
#include "surface/sample/face_metric.h"

namespace carreau {

/// Options of every run for the measures of its mesh: sizes and places along curves, the atlas, geometric limits.
/// Refers to the result. `angle_slack`: of surface_tolerances().
EvaluationOptions evaluation_options(const CompositeOptions& options, const CompositeResult& result, double angle_slack = 1);

/// Measures the mesh of mesh_composite() against the sizes and metrics that its rules prescribe; the arguments are
/// equal to its arguments. Evaluates the host and the sources again. With a gradation, the graded sizes are
/// "prescribed". If the geometry governs, its angle or distance is the limit of edges or triangles. The gradation
/// limits edges, and 1.6 times the gradation the lengths at a vertex.
MeshEvaluation evaluate_composite(const Model& model, const Topology& topology, Cad& cad,
                                  const CompositeOptions& options, const CompositeResult& result, Monitor& monitor);

}  // namespace carreau
