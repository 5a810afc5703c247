// SPDX-License-Identifier: BSD-3-Clause
// Programs that fill surfaces with tetrahedra: TetGen, Gmsh, Netgen. They are run, never linked.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "volume/child_program.h"
#include "volume/inner_sizes.h"
#include "volume/volume_mesh.h"

namespace command {

/// Names of the engines, in the order in which they are looked for.
std::vector<std::string> engine_names();

/// Returns the engine of this name, or the first one on this machine if `name` is "". Throws Failure with the packages to install.
std::string found_engine(const std::string& name);

/// Fills the surface by tetrahedra of sizes within bounds. `input` is its mesh. Throws Failure with the last lines of an engine that fails.
VolumeMesh fill(carreau_mesh* input, const SolidSurface& surface, const std::string& engine, const InnerBounds& bounds, const ProgramLimits& limits,
                const std::function<void(double)>& each_second);

}  // namespace command
