// SPDX-License-Identifier: BSD-3-Clause
// Faces whose geometry is in a shared library.
#pragma once

#include <memory>
#include <string>

#include "inputs/base/cad_input.h"

namespace command {

/// Faces of a .pardom file, with the routines of cad_m in a shared library. Throws Failure.
std::unique_ptr<CadInput> open_pardom(const std::string& path, const std::string& host);

}  // namespace command
