// SPDX-License-Identifier: BSD-3-Clause
// Closed triangulated surfaces as geometry: the C1 surface of an atlas over them.
#pragma once

#include <memory>
#include <string>

#include "inputs/base/input_choice.h"

namespace command {

class CadInput;

/// The value of --surface.
inline constexpr const char* atlas_surface = "atlas";

/// Reads the triangles of a mesh file and makes an atlas of them. Throws Failure.
std::unique_ptr<CadInput> open_atlas(const std::string& path, const AtlasChoice& choice);

}  // namespace command
