// SPDX-License-Identifier: BSD-3-Clause
// Any bytes are a mesh or a FileError that names the file (Cart3D).
#include "mesh_fuzz_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return carreau::fuzz_mesh(data, size, carreau::read_mesh_tri);
}
