// SPDX-License-Identifier: BSD-3-Clause
#include "base/json_output.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace command {

std::string json_format(const std::string& command) { return "carreau " + command + " 1"; }

void print_json(const std::string& command, const nlohmann::ordered_json& value) {
  nlohmann::ordered_json whole = {{"format", json_format(command)}};
  whole.update(value);
  std::puts(whole.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
}

void print_json_error(const std::string& command, const std::string& sentence, int exit_code) {
  print_json(command, {{"error", {{"sentence", sentence}, {"exit", exit_code}}}});
}

}  // namespace command
