// SPDX-License-Identifier: BSD-3-Clause
// Fields of several faces into files.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fields/fields.h"
#include "measure/mesh_evaluation.h"
#include "surface/result.h"
#include "surface/supports.h"

namespace carreau {

/// Input of the writer of fields. References outlive the call.
struct FieldRun {
  const Model& model;
  const Topology& topology;       ///< may be empty: sizes inside faces do not need it
  const ModelSupports* supports;  ///< null: curves are sampled where the host does not fail
  const CompositeResult* result;  ///< null: there is no mesh
  SizeParameters size;
  std::vector<ExrAttribute> parameters;  ///< that the mesh depends on, for each image
  double diag = 0;                       ///< 0: not known
  /// Evaluation of the mesh; called from the caller's thread, and only for the channels of deviations.
  std::function<const MeshEvaluation&()> delivered = {};
};

/// Diagonal of the box of all curves, from their points at which the host does not fail; 0 without such points.
double diag_of_curves(const Model& model, Cad& cad, Monitor& monitor);

/// Writes and returns the names of the files, in the order of the faces. Each appears whole or not at all. The caller's
/// thread alone evaluates `cad`. Throws InvalidArgument (options, a face that does not exist, a suffix other than
/// .exr), FileError, Cancelled.
std::vector<std::string> write_fields(const FieldRun& run, const std::string& path, const FieldOptions& options,
                                      Cad& cad, Monitor& monitor);

}  // namespace carreau
