// SPDX-License-Identifier: BSD-3-Clause
// Data of the steps that make elements out of the triangles of a whole mesh.
#pragma once

#include <vector>

#include "cad/cad.h"
#include "curve/curve_model.h"
#include "curve/discrete_curve.h"
#include "periodic/periodic_model.h"
#include "size/size_rules.h"
#include "support/monitor.h"
#include "surface/layers/layer_curves.h"
#include "surface/options.h"
#include "surface/result.h"

namespace carreau {

/// References only. `result` holds the whole mesh of straight triangles, its faces with (u, v), its curves, and the
/// size prescribed at each vertex. It also holds the metric of (u, v) by face (CompositeResult::spaces; empty if a face
/// has failed, and for some extreme parametrisations). Steps change result.mesh and result.vertex_size. Steps that
/// divide edges of curves change result.curve_size and `curves` too.
struct ElementWork {
  const CurveModel& model;  ///< model, topology, supports and evaluators of curves and faces
  /// Vertex k of a curve of the topology is result.mesh.curves[c].vertices[k], unless a narrow face has vanished there.
  std::vector<DiscreteCurve>& curves;
  const SizeRules& rules;
  const CompositeOptions& options;
  CompositeResult& result;
  Monitor& monitor;
  const PeriodicModel* periodic = nullptr;  ///< null: no face is periodic
  /// Cells of layers by face, and the layers; null: none. Passes keep the cells, cut them, and number them anew.
  std::vector<std::vector<LayerCell>>* layers = nullptr;
  const LayerCurves* layer_curves = nullptr;

  [[nodiscard]] bool has_layers(std::size_t face) const noexcept {
    return layers != nullptr && face < layers->size() && !(*layers)[face].empty();
  }
  [[nodiscard]] bool isotropic() const noexcept { return !rules.uses_metrics(); }
  /// The evaluator; FaceMesh::ref names its faces.
  [[nodiscard]] Cad& cad() const noexcept { return model.cad; }
};

}  // namespace carreau
