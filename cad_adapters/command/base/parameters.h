// SPDX-License-Identifier: BSD-3-Clause
// The parameters of a session.
#pragma once

#include <carreau.h>

#include <string>
#include <vector>

namespace command {

/// All parameters, in alphabetical order.
const std::vector<carreau_parameter>& known_parameters();
std::vector<std::string> parameter_names();

/// True if the parameter has the value of another parameter until it is set itself.
inline bool is_synonym(const carreau_parameter& parameter) { return *parameter.set_by != '\0'; }

}  // namespace command
