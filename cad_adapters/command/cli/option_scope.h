// SPDX-License-Identifier: BSD-3-Clause
// Options that mean something for some kinds of input only.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "inputs/base/input_choice.h"

namespace command {

/// Throws Failure, with the option and the input, when an option was given that means nothing for any of the inputs.
/// `is_plane`: the inputs are domains of the plane.
void check_scope(const CLI::App& sub, const std::vector<std::string>& inputs, const InputChoice& choice, bool is_plane);

}  // namespace command
