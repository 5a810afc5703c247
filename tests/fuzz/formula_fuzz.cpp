// SPDX-License-Identifier: BSD-3-Clause
// Any bytes are a formula that can be evaluated again and again, or a Failure.
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

#include "base/failure.h"
#include "inputs/built/formula.h"
#include "fuzz_check.h"

namespace {

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    const command::Formula formula(text);
    const command::Place here{.x = 1, .y = -2, .z = 0.5, .u = 0, .v = 1e300}, there{.x = -1e-300, .y = 3};
    const double first = formula(here), other = formula(there);
    FUZZ_CHECK(same(formula(here), first));  // a value depends on the place alone
    FUZZ_CHECK(same(formula(there), other));
  } catch (const command::Failure& failure) {
    FUZZ_CHECK(std::strncmp(failure.what(), "The formula", 11) == 0);
  }
  return 0;
}
