// SPDX-License-Identifier: BSD-3-Clause
// The output of `call export` (RT-0232 sec. 4).
#pragma once

#include <string>
#include <vector>

#include "measure/mesh_evaluation.h"
#include "mesh/flat_mesh.h"
#include "model/model.h"
#include "surface/result.h"
#include "surface/supports.h"

namespace carreau {

/// The input of an export.
struct ExportSource {
  const SurfaceMesh& mesh;
  const std::vector<double>& vertex_size;
  const Model& model;
  const ModelSupports& supports;
  const MeshEvaluation* delivered = nullptr;  ///< its values become fields; nullptr: none
  bool with_fields = true;                    ///< size, Q1 and Q2, which a few formats hold
};

/// `option` is "", allsurf3d, allsurf2d, onesurf3d, onesurf2d or smo3d; `face` the reference for onesurf*; `with_edges` is
/// flag = 1. onesurf2d of a face without triangles exports its curves in the parameter plane, as their supports have them,
/// which shows why meshing failed. Optional fields: size (vertices), Q1 and Q2 (triangles) in 3-D. Throws InvalidArgument for
/// a face that does not exist or an unknown option. With `delivered`: its values as fields, in 2-D as well, and with_edges
/// gives every edge once, with reference 0 inside faces.
FlatMesh export_mesh(const ExportSource& source, const std::string& option, int face, bool with_edges);

}  // namespace carreau
