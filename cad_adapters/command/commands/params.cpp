// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "base/json_output.h"
#include "base/lengths.h"
#include "base/parameters.h"
#include "base/suggestions.h"
#include "commands/commands.h"

namespace command {
namespace {

std::string default_of(const carreau_parameter& p) {
  if (p.type == CARREAU_TEXT) return '"' + std::string(p.default_text) + '"';
  return number_text(p.default_number) + (p.diag_relative != 0 ? " diag" : "");
}

/// Bounds that every number respects are not worth printing.
std::string range_of(const carreau_parameter& p) {
  if (p.type == CARREAU_TEXT) return p.choices;
  const bool any = p.type == CARREAU_INTEGER && p.minimum <= INT32_MIN && p.maximum >= INT32_MAX;
  if (any) return "";
  const bool no_maximum = p.type == CARREAU_INTEGER ? p.maximum >= INT32_MAX : std::isinf(p.maximum);
  if (no_maximum && p.minimum > 0 && p.minimum < 1e-300) return "> 0";
  if (no_maximum) return ">= " + number_text(p.minimum);
  return number_text(p.minimum) + " to " + number_text(p.maximum);
}

nlohmann::ordered_json json_of(const carreau_parameter& p) {
  nlohmann::ordered_json row = {{"name", p.name}, {"help", p.help}};
  if (is_synonym(p)) row["set_by"] = p.set_by;
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

void print_row(const carreau_parameter& p) {
  const char* type = p.type == CARREAU_INTEGER ? "integer" : p.type == CARREAU_REAL ? "real" : "text";
  const std::string range = range_of(p);
  std::printf("%-20s %-8s default %-12s%s%s\n    %s\n", p.name, type, default_of(p).c_str(), range.empty() ? "" : " values ",
              range.c_str(), p.help);
  if (is_synonym(p)) std::printf("    follows %s until it is set itself\n", p.set_by);
}

/// One line for each parameter that has synonyms.
void print_synonyms() {
  std::map<std::string, std::string> names;  // by parameter
  for (const carreau_parameter& p : known_parameters())
    if (is_synonym(p)) names[p.set_by] += std::string(names[p.set_by].empty() ? "" : ", ") + p.name;
  for (const auto& [parameter, synonyms] : names)
    std::printf("synonyms of %s: %s\n    %s sets them until they are set themselves; `carreau params NAME` describes them\n",
                parameter.c_str(), synonyms.c_str(), parameter.c_str());
}

}  // namespace

int params(const ParamsOptions& options) {
  const std::string& name = options.name;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  bool found = false;
  for (const carreau_parameter& p : known_parameters()) {
    if (!name.empty() && name != p.name) continue;
    found = true;
    if (options.json)
      list.push_back(json_of(p));
    else if (!name.empty() || !is_synonym(p))
      print_row(p);
  }
  if (name.empty() && !options.json) print_synonyms();
  if (!found)
    throw Failure("There is no parameter '" + name + "'" + did_you_mean(name, parameter_names()) +
                  " `carreau params` lists them all.");
  if (options.json) print_json("params", {{"parameters", list}});
  return 0;
}

}  // namespace command
