// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdint>

#include "fuzz_check.h"
#include "io/molecule/elements.h"
#include "support/error.h"

/// Any bytes are positive radii, or a FileError that names the file and a line.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    for (const auto& [symbol, radius] : carreau::read_radii({reinterpret_cast<const char*>(data), size}, "x"))
      FUZZ_CHECK(!symbol.empty() && radius > 0 && std::isfinite(radius));
  } catch (const carreau::FileError& error) {
    FUZZ_CHECK(error.where().file == "x" && error.where().line > 0);
  }
  return 0;
}
