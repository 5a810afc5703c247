// SPDX-License-Identifier: BSD-3-Clause
// Completion of command lines by shells.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace command {

/// Prints a script for bash, zsh or fish that completes the sub-commands of `app`, their options and values. Returns
/// the exit code.
int print_completion(const CLI::App& app, const std::string& shell);

}  // namespace command
