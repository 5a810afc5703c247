// SPDX-License-Identifier: BSD-3-Clause
// Any word of the command line is a length, an assignment or numbers of pixels, or a Failure that names the option.
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/failure.h"
#include "fuzz_check.h"
#include "base/lengths.h"

namespace {

void check_length(const std::string& text) {
  try {
    const command::Length length = command::parse_length(text, "--size");
    FUZZ_CHECK(std::isfinite(length.value) && length.value > 0);
    FUZZ_CHECK(length.relative == (text.back() == '%'));
    FUZZ_CHECK(length.of(2) == (length.relative ? 2 * length.value : length.value));
  } catch (const command::Failure& failure) {
    FUZZ_CHECK(std::string_view(failure.what()).starts_with("--size '"));
  }
}

void check_assignment(const std::string& text) {
  try {
    const auto [name, value] = command::parse_assignment(text, "--set");
    FUZZ_CHECK(!name.empty() && !value.empty() && name + "=" + value == text);
    FUZZ_CHECK(value.find('=') == std::string::npos);
  } catch (const command::Failure& failure) {
    FUZZ_CHECK(std::string_view(failure.what()).starts_with("--set '"));
    const std::size_t at = text.rfind('=');
    FUZZ_CHECK(at == std::string::npos || at == 0 || at + 1 == text.size());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  check_length(text);
  check_assignment(text);
  if (const auto count = command::parse_count(text)) FUZZ_CHECK(*count > 0);
  if (const auto pixels = command::parse_pixels(text)) {
    FUZZ_CHECK(pixels->first > 0 && pixels->second > 0);
    FUZZ_CHECK(!command::parse_count(text));
  }
  return 0;
}
