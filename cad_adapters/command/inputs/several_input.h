// SPDX-License-Identifier: BSD-3-Clause
// Several files as one geometry.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "inputs/base/cad_input.h"

namespace command {

/// Files of triangles, Bezier patches, grids or molecules side by side: faces are those of the first file, then those of
/// the next one, whose numbers go on, ... Throws Failure, also for files of other kinds.
std::unique_ptr<CadInput> open_several(const std::vector<std::string>& paths, const InputChoice& choice);

}  // namespace command
