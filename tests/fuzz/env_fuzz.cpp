// SPDX-License-Identifier: BSD-3-Clause
// Any bytes are pairs of words or a FileError that names file and line.
#include <cstdint>

#include "fuzz_check.h"
#include "io/model/env.h"
#include "support/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    int line = 0;
    for (const carreau::EnvPair& pair : carreau::read_env_text(text, "blsurf.env")) {
      FUZZ_CHECK(!pair.name.empty());
      FUZZ_CHECK(pair.quoted || !pair.value.empty());
      FUZZ_CHECK(pair.line > 0 && pair.line >= line);
      line = pair.line;
    }
  } catch (const carreau::FileError& error) {
    FUZZ_CHECK(error.where().file == "blsurf.env" && error.where().line > 0);
  }
  return 0;
}
