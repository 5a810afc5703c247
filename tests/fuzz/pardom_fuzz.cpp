// SPDX-License-Identifier: BSD-3-Clause
// Any bytes are a model or a FileError that names the file; a model is written and read back to the same text.
#include <cstdint>

#include "fuzz_check.h"
#include "io/model/pardom.h"
#include "support/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  carreau::Model model;
  try {
    model = carreau::read_pardom_text(text, "x.pardom");
  } catch (const carreau::FileError& error) {
    FUZZ_CHECK(error.where().file == "x.pardom" && error.where().line > 0);
    return 0;
  }
  FUZZ_CHECK(!model.faces.empty());
  const std::string written = carreau::pardom_text(model);
  FUZZ_CHECK(carreau::pardom_text(carreau::read_pardom_text(written, "again")) == written);
  return 0;
}
