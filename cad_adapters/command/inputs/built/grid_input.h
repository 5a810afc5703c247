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

/// Whether a format is given, or the suffix is that of a grid, or a file .xyz begins as one of PLOT3D.
bool is_grid(const std::string& path, const GridChoice& choice);
/// "" or what is wrong with the text of --smooth.
std::string smoothing_defect(const std::string& text);

/// Throws Failure.
std::unique_ptr<CadInput> open_grid(const std::string& path, const GridChoice& choice);

}  // namespace command
