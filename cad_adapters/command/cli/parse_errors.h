// SPDX-License-Identifier: BSD-3-Clause
// Sentences for command lines that cannot be parsed.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace command {

/// "mesh, plane, ...".
std::string command_names(const CLI::App& app);
/// The error about an unknown command, with suggestions.
std::string unknown_command(const std::string& word, const CLI::App& app);
/// The error in the command line `words` of `sub`, with suggestions.
std::string sentence_of(const CLI::ParseError& error, const CLI::App& sub, const std::vector<std::string>& words);

}  // namespace command
