// SPDX-License-Identifier: BSD-3-Clause
// What a run delivered, against what it was asked.
#pragma once

#include "measure/mesh_evaluation.h"
#include "surface/options.h"
#include "surface/result.h"
#include "surface/sample/face_metric.h"

namespace carreau {

/// What every run says of its mesh: sizes and places along curves, the atlas, geometric limits. Refers to the result.
/// `angle_slack`: of surface_tolerances().
EvaluationOptions evaluation_options(const CompositeOptions& options, const CompositeResult& result, double angle_slack = 1);

/// Measures the mesh of mesh_composite(), called with the same arguments, against the sizes and metrics that its rules
/// prescribe: asked again, from the host and from sources. With a gradation
/// "prescribed" is what it left. Where the geometry governs, its angle or distance is the limit of edges or triangles;
/// the gradation is that of edges, 1.6 times it that of the lengths at a vertex.
MeshEvaluation evaluate_composite(const Model& model, const Topology& topology, Cad& cad,
                                  const CompositeOptions& options, const CompositeResult& result, Monitor& monitor);

}  // namespace carreau
