// SPDX-License-Identifier: BSD-3-Clause
// BL2D's .bl2d: a mesh that was read is written and read back to the same text; and its .h.
#include <cstdint>

#include "fuzz_check.h"
#include "io/mesh_files.h"
#include "io/mesh_writers.h"
#include "io/plane/plane_files.h"
#include "support/error.h"

namespace {

template <typename Read>
void check(std::string_view text, Read&& read) {
  try {
    read(text, "x");
  } catch (const carreau::FileError& error) {
    FUZZ_CHECK(error.where().file == "x" && error.where().line > 0);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  check(text, [](std::string_view given, const std::string& name) {
    const std::string written = carreau::bl2d_text(carreau::read_mesh_bl2d(given, name));
    FUZZ_CHECK(carreau::bl2d_text(carreau::read_mesh_bl2d(written, name)) == written);
  });
  check(text, [](std::string_view given, const std::string& name) {
    const carreau::Solution solution = carreau::read_bl2d_sizes_text(given, name);
    FUZZ_CHECK(solution.values.size() == solution.count() * solution.components());
  });
  return 0;
}
