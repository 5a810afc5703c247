// SPDX-License-Identifier: BSD-3-Clause
// Triangle's .node.
#include "plane_fuzz_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return carreau::fuzz_plane(data, size, carreau::read_node_text);
}
