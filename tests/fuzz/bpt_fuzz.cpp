// Any bytes are Bezier patches or a Failure that names file and line.
#include <cmath>
#include <cstdint>
#include <string_view>

#include "bezier_file.h"
#include "failure.h"
#include "fuzz_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const auto patches = command::parse_bezier(text, "x.bpt");
    FUZZ_CHECK(!patches.empty());
    for (const command::BezierPatch& patch : patches) {
      FUZZ_CHECK(patch.m >= 1 && patch.m <= command::largest_bezier_degree);
      FUZZ_CHECK(patch.n >= 1 && patch.n <= command::largest_bezier_degree);
      FUZZ_CHECK(patch.control.size() == static_cast<std::size_t>((patch.m + 1) * (patch.n + 1)));
      for (const auto& point : patch.control)
        for (const double x : point) FUZZ_CHECK(std::isfinite(x));
    }
  } catch (const command::Failure& failure) {
    FUZZ_CHECK(std::string_view(failure.what()).starts_with("'x.bpt', line "));
  }
  return 0;
}
