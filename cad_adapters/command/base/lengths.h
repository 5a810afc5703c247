// SPDX-License-Identifier: BSD-3-Clause
// Numbers and words on the command line.
#pragma once

#include <optional>
#include <string>
#include <utility>

namespace command {

/// "2.5" or "1%", a share of the diagonal.
struct Length {
  double value = 0;
  bool relative = false;  ///< value is a share: 1% is 0.01

  [[nodiscard]] double of(double diagonal) const noexcept { return relative ? value * diagonal : value; }
};

/// `option` is named in the sentence. Throws Failure unless the text is a positive finite number, alone or followed by
/// '%'.
Length parse_length(const std::string& text, const std::string& option);

/// A number with so many significant digits.
std::string number_text(double x, int digits = 6);

/// "left=right" at the last '='. Throws Failure when '=' is missing, or a side is empty.
std::pair<std::string, std::string> parse_assignment(const std::string& text, const std::string& option);

/// "1024": a number above 0. nullopt: not such a number.
std::optional<int> parse_count(const std::string& text);

/// "800x600". nullopt: not two numbers above 0 with an x between.
std::optional<std::pair<int, int>> parse_pixels(const std::string& text);

}  // namespace command
