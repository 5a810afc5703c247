// SPDX-License-Identifier: BSD-3-Clause
// From the mesh of a surface to verified tetrahedra.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "mesh/mesh_options.h"
#include "mesh/progress.h"
#include "volume/inner_sizes.h"
#include "volume/volume_mesh.h"

namespace command {

/// Checks the surface, runs the engine, verifies the result and adds nodes on edges. `kept`: a file that gets the surface when the engine
/// fails. Throws Failure.
VolumeMesh fill_solids(carreau_mesh* mesh, const MeshOptions& options, const std::string& engine, const InnerBounds& bounds, const std::string& kept,
                       Progress& progress);

/// "volume     tetgen, 3955 tetrahedra, 958 vertices, 0.2 s", and a line for each solid.
std::vector<std::string> volume_lines(const VolumeMesh& volume);
nlohmann::ordered_json volume_json(const VolumeMesh& volume);

}  // namespace command
