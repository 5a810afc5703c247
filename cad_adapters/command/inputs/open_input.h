// SPDX-License-Identifier: BSD-3-Clause
// Opens a geometry of any format.
#pragma once

#include <memory>
#include <string>

#include "inputs/base/cad_input.h"

namespace command {

/// True if the suffix (.pardom) stands for a model without geometry, which a shared library provides.
bool needs_host(const std::string& path);
/// Throws Failure when the name of an input is empty.
void check_geometry_name(const std::string& path);

/// Opens a formula, or a file by its suffix: Bezier patches (.bpt); faces and curves (.pardom) with a shared library; a
/// molecule; a grid; triangles; or a file for open_cad(). Throws Failure with a sentence, also if the choice is missing
/// or useless. `progress` receives the finished share, if it is known.
std::unique_ptr<CadInput> open_input(const std::string& path, const InputChoice& choice,
                                     const ReadingProgress& progress = {});

}  // namespace command
