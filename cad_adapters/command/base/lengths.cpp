// SPDX-License-Identifier: BSD-3-Clause
#include "base/lengths.h"

#include <charconv>
#include <cmath>
#include <cstdio>

#include "base/failure.h"

namespace command {

Length parse_length(const std::string& text, const std::string& option) {
  Length length;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, length.value);
  length.relative = error == std::errc{} && rest + 1 == end && *rest == '%';
  if (length.relative) length.value /= 100;
  if (error != std::errc{} || (rest != end && !length.relative) || !std::isfinite(length.value) || length.value <= 0)
    throw Failure(option + " '" + text +
                  "' is not a length: a number above 0, or a share of the model's diagonal such as 1%.");
  return length;
}

std::string number_text(double x, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, x);
  return text;
}

std::pair<std::string, std::string> parse_assignment(const std::string& text, const std::string& option) {
  const std::size_t at = text.rfind('=');
  if (at == std::string::npos || at == 0 || at + 1 == text.size())
    throw Failure(option + " '" + text + "' is not NAME=VALUE.");
  return {text.substr(0, at), text.substr(at + 1)};
}

std::optional<int> parse_count(const std::string& text) {
  int value = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || rest != text.data() + text.size() || value < 1) return std::nullopt;
  return value;
}

std::optional<std::pair<int, int>> parse_pixels(const std::string& text) {
  const std::size_t x = text.find('x');
  if (x == std::string::npos) return std::nullopt;
  const auto width = parse_count(text.substr(0, x)), height = parse_count(text.substr(x + 1));
  if (!width || !height) return std::nullopt;
  return std::pair{*width, *height};
}

}  // namespace command
