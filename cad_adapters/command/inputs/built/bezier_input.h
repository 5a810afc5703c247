// SPDX-License-Identifier: BSD-3-Clause
// Bezier patches as geometry.
#pragma once

#include <memory>
#include <string>

#include "inputs/base/cad_input.h"

namespace command {

/// Patches of a .bpt file: faces 1, 2, ...; sides that meet become one curve by gluing. Throws Failure.
std::unique_ptr<CadInput> open_bezier(const std::string& path);

}  // namespace command
