// SPDX-License-Identifier: BSD-3-Clause
// Gradation over a whole model: across curves and patches, on curves as on surfaces (HDR sec. 1.1.2).
#pragma once

#include <memory>
#include <vector>

#include "curve/curve_sizes.h"
#include "gradation/graded_field.h"
#include "periodic/periodic_model.h"
#include "surface/options.h"

namespace carreau {

/// Sizes that obey a gradation.
struct GradedModel {
  std::shared_ptr<const GradedField> field;  ///< bounds the sizes inside faces
  std::vector<SizeSamples> curves;           ///< by curve (index in Topology::curves): bounded already
  int rounds = 0;                            ///< graphs that were made
  std::size_t triangles = 0;                 ///< of the last graph
  /// Steep places of fields in space that the samples of a graph have missed, by face.
  std::vector<std::vector<Vec2>> missed = {};
};

/// Grades the sizes of a model with the ratio options.gradation > 1. The graph is a separate mesh of twice the
/// prescribed sizes, with prescribed sizes at its vertices and distances along its edges. If the graded sizes are much
/// smaller than its edges, the graph is made again with them. Faces whose domains cannot be made are left out.
/// Evaluates the host about as often as a mesh of a quarter of the vertices would, curves once. Sizes grow across periodic
/// curves. Throws the exceptions of the host, LimitError, Cancelled.
GradedModel grade_model(const CurveModel& model, SizeRules& rules, const CompositeOptions& options, double diag,
                        Monitor& monitor, const PeriodicModel& periodic = {});

}  // namespace carreau
