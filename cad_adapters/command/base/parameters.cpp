// SPDX-License-Identifier: BSD-3-Clause
#include "base/parameters.h"

#include "base/failure.h"

namespace command {

const std::vector<carreau_parameter>& known_parameters() {
  static const std::vector<carreau_parameter> all = [] {
    std::vector<carreau_parameter> list(static_cast<std::size_t>(carreau_parameter_count()));
    for (std::size_t i = 0; i < list.size(); ++i) {
      list[i].struct_size = sizeof list[i];
      if (carreau_parameter_info(static_cast<std::int32_t>(i), &list[i]) != CARREAU_OK)
        throw Failure("The parameters cannot be listed.");
    }
    return list;
  }();
  return all;
}

std::vector<std::string> parameter_names() {
  std::vector<std::string> names;
  for (const carreau_parameter& parameter : known_parameters()) names.emplace_back(parameter.name);
  return names;
}

}  // namespace command
