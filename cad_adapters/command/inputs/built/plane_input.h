// SPDX-License-Identifier: BSD-3-Clause
// Plane domains as geometry.
#pragma once

#include <memory>
#include <string>

#include "inputs/base/input_choice.h"

namespace command {

class CadInput;

/// True if the suffix belongs to plane domains.
bool is_plane_file(const std::string& path);

/// Throws Failure.
std::unique_ptr<CadInput> open_plane(const std::string& path, const PlaneChoice& choice);

}  // namespace command
