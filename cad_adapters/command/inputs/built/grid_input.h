// SPDX-License-Identifier: BSD-3-Clause
// Structured grids as geometry.
#pragma once

#include <memory>
#include <string>

#include "inputs/base/input_choice.h"

namespace command {

class CadInput;

inline constexpr const char* grid_formats[] = {"plot3d", "heights", "scan", "nodes"};
inline constexpr const char* grid_suffixes[] = {".fmt", ".p3d", ".x", ".grd", ".asc", ".dem", ".txt", ".cyl", ".ijk"};

/// True if a format is given, if the suffix belongs to grids, or if a file .xyz begins as PLOT3D does.
bool is_grid(const std::string& path, const GridChoice& choice);
/// The error in the text of --smooth; "": no error.
std::string smoothing_defect(const std::string& text);

/// Throws Failure.
std::unique_ptr<CadInput> open_grid(const std::string& path, const GridChoice& choice);

}  // namespace command
