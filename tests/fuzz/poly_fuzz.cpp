// SPDX-License-Identifier: BSD-3-Clause
// Triangle's .poly.
#include "plane_fuzz_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return carreau::fuzz_plane(data, size, [](std::string_view text, const std::string& name) {
    return carreau::read_poly_text(text, name);
  });
}
