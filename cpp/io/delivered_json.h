// SPDX-License-Identifier: BSD-3-Clause
// The summary of the measures, as JSON.
#pragma once

#include <string>

#include "measure/mesh_evaluation.h"
#include "surface/result.h"

namespace carreau {

/// One object, indented, ending with a newline; keys always the same and in the same order. A number that is not finite
/// (a limit that was not requested, the mean of no values) is null. Times, which differ from run to run, stand last, in
/// "seconds".
std::string delivered_json(const SurfaceMesh& mesh, const CompositeReport& report, const MeshEvaluation& delivered);

}  // namespace carreau
