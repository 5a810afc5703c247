#include "json_output.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace command {

void print_json(const nlohmann::ordered_json& value) {
  std::puts(value.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
}

}  // namespace command
