// SPDX-License-Identifier: BSD-3-Clause
// JSON on the standard output.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace command {

/// The member "format" of a sub-command's output: "carreau mesh 1". The number grows when a member changes its meaning
/// or is removed; new members do not change it.
std::string json_format(const std::string& command);

/// Prints an object with its "format" first, an indent of 1 and a newline. Texts may be in any encoding: bytes that are
/// not UTF-8 are replaced.
void print_json(const std::string& command, const nlohmann::ordered_json& value);

/// Prints an object about a failure in place of the output: "format", and "error" with the sentence and the exit code.
void print_json_error(const std::string& command, const std::string& sentence, int exit_code);

}  // namespace command
