#include <cmath>
#include <cstdint>
#include <cstdio>

#include "commands.h"

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

int params(const std::string& name) {
  bool found = false;
  for (std::int32_t i = 0; i < carreau_parameter_count(); ++i) {
    carreau_parameter p{};
    p.struct_size = sizeof p;
    if (carreau_parameter_info(i, &p) != CARREAU_OK) throw Failure("The parameters cannot be listed.");
    if (!name.empty() && name != p.name) continue;
    found = true;
    const char* type = p.type == CARREAU_INTEGER ? "integer" : p.type == CARREAU_REAL ? "real" : "text";
    const std::string range = range_of(p);
    std::printf("%-20s %-8s default %-12s%s%s\n    %s\n", p.name, type, default_of(p).c_str(),
                range.empty() ? "" : " values ", range.c_str(), p.help);
  }
  if (!found) throw Failure("There is no parameter '" + name + "'; `carreau params` lists them all.");
  return 0;
}

}  // namespace command
