// SPDX-License-Identifier: BSD-3-Clause
// The ASCII form of solutions.
#include "sol_fuzz_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return carreau::fuzz_solution(data, size, carreau::read_solution_text);
}
