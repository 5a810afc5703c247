// SPDX-License-Identifier: BSD-3-Clause
#include "session/output/field_attributes.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

namespace carreau {

namespace {

// Parameters that do not change a mesh.
bool leaves_mesh(std::string_view parameter) {
  constexpr std::array names{"association", "curve_groups", "element", "flag", "format", "option", "pref", "refs", "solid_groups", "threads", "verb"};
  return std::find(names.begin(), names.end(), parameter) != names.end();
}

}  // namespace

std::vector<ExrAttribute> field_attributes(const Parameters& parameters, double diag) {
  std::vector<ExrAttribute> attributes;
  const double known_diag = diag > 0 ? diag : std::numeric_limits<double>::quiet_NaN();
  for (const ParameterInfo& info : parameter_table()) {
    if (leaves_mesh(info.name)) continue;
    const std::string name = std::string("parameter.") + info.name;
    if (info.type == ParameterType::integer)
      attributes.push_back({name, std::int32_t{parameters.integer(info.name)}});
    else if (info.type == ParameterType::real)
      attributes.push_back({name, parameters.real(info.name, known_diag)});
    else if (const std::string text = parameters.text(info.name); !text.empty())
      attributes.push_back({name, text});
  }
  return attributes;
}

}  // namespace carreau
