// SPDX-License-Identifier: BSD-3-Clause
// Several files as one geometry.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "inputs/base/cad_input.h"

namespace command {

/// Files of triangles, Bezier patches, grids or molecules side by side. The faces of each file get the numbers behind
/// the faces of the previous files. Throws Failure, also for files of other kinds.
std::unique_ptr<CadInput> open_several(const std::vector<std::string>& paths, const InputChoice& choice);

}  // namespace command
