// SPDX-License-Identifier: BSD-3-Clause
// Edges prescribed on curves, and rows of cells along them: --curve-edges, --curve-vertices, --layers.
#pragma once

#include <carreau.h>

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "inputs/base/cad_input.h"
#include "mesh/mesh_options.h"

namespace command {

/// Throws Failure for words that are no prescription, before anything is read.
void check_curve_edges(const MeshOptions& options);

/// Hands the prescriptions to a session that has the model. Throws Failure: no such curve, numbers that the library
/// rejects.
void prescribe_curve_edges(carreau_session* session, const MeshOptions& options, const CadInput& input);

/// Throws Failure for words that are no layers, before anything is read.
void check_layers(const MeshOptions& options);

/// Hands the layers to a session that has the model. Throws Failure: no such edge, numbers that the library rejects.
void add_layers(carreau_session* session, const MeshOptions& options, const CadInput& input);

/// A sentence on the layers of the last mesh that lack rows on some edges; empty: all edges have rows.
std::string missing_rows(carreau_session* session, const MeshOptions& options);

/// The figures of each set of layers of the last mesh. `diagonal`: of the model.
nlohmann::ordered_json layers_json(carreau_session* session, const MeshOptions& options, double diagonal);
/// Lines with y+ of the first rows, for layers with a friction velocity over viscosity.
std::vector<std::string> y_plus_lines(carreau_session* session, const MeshOptions& options);

}  // namespace command
