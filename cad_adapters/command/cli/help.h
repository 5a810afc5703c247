// SPDX-License-Identifier: BSD-3-Clause
// Help: options in groups, one line each. A command with many options prints its most used options, and all of them by --help-all.
#pragma once

#include <CLI/CLI.hpp>

namespace command {

/// Sets the formatter of help, and --help-all. Called before sub-commands are added.
void set_help(CLI::App& app);

/// Puts the options of each sub-command into their groups, in the order in which help and manual pages print them.
void arrange_options(CLI::App& app);

}  // namespace command
