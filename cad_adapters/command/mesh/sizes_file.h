// SPDX-License-Identifier: BSD-3-Clause
// Files of sizes (.json), for runs that repeat.
#pragma once

#include <string>

#include "mesh/mesh_options.h"

namespace command {

/// Reads the file of --sizes into the options, if one is given. Its keys are options of sizes and curvature. A length
/// or number of the command line takes precedence; rules of the command line follow the rules of the file. Throws
/// Failure with the file and the line, or the key.
void read_sizes(MeshOptions& options);

/// "--near", or "sizes.json: near" for a rule of the file.
std::string name_of_rule(const SizesFile& file, const std::string& option, bool is_in_file);

}  // namespace command
