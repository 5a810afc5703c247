// SPDX-License-Identifier: BSD-3-Clause
#include "grid_fuzz_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return carreau::fuzz_grid(
      data, size, [](std::string_view text, const std::string& name) { return carreau::read_heights(text, name); });
}
