// SPDX-License-Identifier: BSD-3-Clause
// Opens a geometry of any format.
#pragma once

#include <memory>
#include <string>

#include "inputs/base/cad_input.h"

namespace command {

/// Whether the name says that the file has no geometry of its own (.pardom): a shared library gives it.
bool needs_host(const std::string& path);
/// Throws Failure when the name of an input is empty.
void check_geometry_name(const std::string& path);

/// Opens a formula, or a file by its suffix: Bezier patches (.bpt); faces and curves (.pardom) with a shared library; a
/// molecule; a grid; triangles; or what open_cad() reads. Throws Failure with a sentence, also where the choice is missing
/// or of no use. `progress` is told the share that is done, where it is known.
std::unique_ptr<CadInput> open_input(const std::string& path, const InputChoice& choice,
                                     const ReadingProgress& progress = {});

}  // namespace command
