// SPDX-License-Identifier: BSD-3-Clause
#include "molecule_fuzz_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return carreau::fuzz_molecule(data, size, carreau::read_xyz);
}
