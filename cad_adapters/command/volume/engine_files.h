// SPDX-License-Identifier: BSD-3-Clause
// Files that engines exchange with this program.
#pragma once

#include <string>
#include <vector>

#include "volume/volume_mesh.h"

namespace command {

void write_engine_file(const std::string& path, const std::string& text);

/// Read vertices, tetrahedra and the numbers of their solids. Throw Failure when a file is missing or not as expected.
/// TetGen: base.node and base.ele; attributes are the numbers of solids.
void read_tetgen(const std::string& base, VolumeMesh& volume);
/// Gmsh's format 2.2; entities are solids.
void read_gmsh(const std::string& path, VolumeMesh& volume);
/// Netgen's .vol; domain i, from 1, is solid numbers[i - 1].
void read_netgen(const std::string& path, const std::vector<std::int32_t>& numbers, VolumeMesh& volume);

}  // namespace command
