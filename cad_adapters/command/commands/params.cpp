// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/json_output.h"
#include "base/suggestions.h"
#include "commands/commands.h"

namespace command {
namespace {

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

std::string default_of(const carreau_parameter& p) {
  if (p.type == CARREAU_TEXT) return '"' + std::string(p.default_text) + '"';
  return number(p.default_number) + (p.diag_relative != 0 ? " diag" : "");
}

/// Bounds that every number respects are not worth printing.
std::string range_of(const carreau_parameter& p) {
  if (p.type == CARREAU_TEXT) return p.choices;
  const bool any = p.type == CARREAU_INTEGER && p.minimum <= INT32_MIN && p.maximum >= INT32_MAX;
  if (any) return "";
  const bool no_maximum = p.type == CARREAU_INTEGER ? p.maximum >= INT32_MAX : std::isinf(p.maximum);
  if (no_maximum && p.minimum > 0 && p.minimum < 1e-300) return "> 0";
  if (no_maximum) return ">= " + number(p.minimum);
  return number(p.minimum) + " to " + number(p.maximum);
}

}  // namespace

namespace {

nlohmann::ordered_json json_of(const carreau_parameter& p) {
  nlohmann::ordered_json row = {{"name", p.name}, {"help", p.help}};
  if (p.type == CARREAU_TEXT) {
    row["type"] = "text", row["default"] = p.default_text;
    if (p.choices != nullptr && *p.choices != '\0') row["choices"] = p.choices;
    return row;
  }
  row["type"] = p.type == CARREAU_INTEGER ? "integer" : "real";
  row["default"] = p.default_number;
  row["of_diagonal"] = p.diag_relative != 0;
  row["minimum"] = p.minimum;
  row["maximum"] = std::isinf(p.maximum) ? nlohmann::ordered_json() : nlohmann::ordered_json(p.maximum);
  return row;
}

}  // namespace

int params(const ParamsOptions& options) {
  const std::string& name = options.name;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  bool found = false;
  for (std::int32_t i = 0; i < carreau_parameter_count(); ++i) {
    carreau_parameter p{};
    p.struct_size = sizeof p;
    if (carreau_parameter_info(i, &p) != CARREAU_OK) throw Failure("The parameters cannot be listed.");
    if (!name.empty() && name != p.name) continue;
    found = true;
    if (options.json) {
      list.push_back(json_of(p));
      continue;
    }
    const char* type = p.type == CARREAU_INTEGER ? "integer" : p.type == CARREAU_REAL ? "real" : "text";
    const std::string range = range_of(p);
    std::printf("%-20s %-8s default %-12s%s%s\n    %s\n", p.name, type, default_of(p).c_str(),
                range.empty() ? "" : " values ", range.c_str(), p.help);
  }
  if (!found)
    throw Failure("There is no parameter '" + name + "'" + did_you_mean(name, parameter_names()) +
                  " `carreau params` lists them all.");
  if (options.json) print_json("params", {{"parameters", list}});
  return 0;
}

}  // namespace command
