// SPDX-License-Identifier: BSD-3-Clause
// Edges prescribed on curves: --curve-edges and --curve-vertices.
#pragma once

#include <carreau.h>

#include "inputs/base/cad_input.h"
#include "mesh/mesh_options.h"

namespace command {

/// Throws Failure for words that are no prescription, before anything is read.
void check_curve_edges(const MeshOptions& options);

/// Hands the prescriptions to a session that has the model. Throws Failure: no such curve, numbers that the library
/// rejects.
void prescribe_curve_edges(carreau_session* session, const MeshOptions& options, const CadInput& input);

}  // namespace command
