// SPDX-License-Identifier: BSD-3-Clause
// STEP, IGES and BREP files as input, with or without OpenCASCADE.
#pragma once

#include <memory>
#include <string>

#include "inputs/base/cad_input.h"

namespace command {

/// Opens STEP, IGES and BREP files. Throws Failure with a sentence.
std::unique_ptr<CadInput> open_cad(const std::string& path, bool loose_edges, const ReadingProgress& progress);

}  // namespace command
