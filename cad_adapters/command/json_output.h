// JSON on the standard output.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace command {

/// Prints a value with an indent of 1 and a newline. Texts may be in any encoding: what is not UTF-8 is replaced.
void print_json(const nlohmann::ordered_json& value);

}  // namespace command
