// SPDX-License-Identifier: BSD-3-Clause
// The input and the measures of a mesh.
#pragma once

#include <memory>

#include "cad/cad.h"
#include "measure/mesh_evaluation.h"
#include "model/model.h"
#include "size/background.h"
#include "surface/options.h"
#include "surface/result.h"
#include "surface/supports.h"

namespace carreau {

namespace discrete {
class DiscreteCad;
}
struct PartResults;

/// The input of a mesh; measures evaluate it again.
struct Meshed {
  std::shared_ptr<Cad> cad;
  std::shared_ptr<const discrete::DiscreteCad> triangles;
  std::shared_ptr<PrescriptionSource> metric_callbacks, prescription_source, uniform_parameters;  // of `options`, as is the next
  std::shared_ptr<BackgroundField> background;
  Model model;
  ModelSupports supports;
  Topology topology;
  CompositeOptions options;
  bool bounds_to_input = false;  // the measures report them
};

/// Finite differences of a host without derivatives have the steps of each domain and stay inside it.
void set_parameter_domains(const Model& model, const ModelSupports& supports, Cad& cad);

/// Measures `result` on its geometry, sources and options. `parts`: the parts of a result that has patches and
/// triangles; null: the result has one kind.
MeshEvaluation evaluate_meshed(const Meshed& meshed, const CompositeResult& result, const PartResults* parts,
                               Monitor& monitor);

}  // namespace carreau
