// SPDX-License-Identifier: BSD-3-Clause
// Any bytes are Bezier patches or a FileError that names file and line.
#include <cmath>
#include <cstdint>
#include <string_view>

#include "fuzz_check.h"
#include "io/model/bezier_reader.h"
#include "support/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const auto patches = carreau::parse_bezier(text, "x.bpt");
    FUZZ_CHECK(!patches.empty());
    for (const carreau::BezierPatch& patch : patches) {
      FUZZ_CHECK(patch.m >= 1 && patch.m <= carreau::largest_bezier_degree);
      FUZZ_CHECK(patch.n >= 1 && patch.n <= carreau::largest_bezier_degree);
      FUZZ_CHECK(patch.control.size() == static_cast<std::size_t>((patch.m + 1) * (patch.n + 1)));
      for (const carreau::Vec3& point : patch.control) FUZZ_CHECK(carreau::is_finite(point));
    }
  } catch (const carreau::FileError& error) {
    FUZZ_CHECK(std::string_view(error.what()).starts_with("x.bpt, line "));
  }
  return 0;
}
