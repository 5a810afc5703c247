// SPDX-License-Identifier: BSD-3-Clause
// Airfoils.
#include "plane_fuzz_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return carreau::fuzz_plane(data, size, carreau::read_airfoil_text);
}
