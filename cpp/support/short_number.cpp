// SPDX-License-Identifier: BSD-3-Clause
#include "support/short_number.h"

#include <array>
#include <charconv>
#include <cmath>

#include "support/format.h"

namespace carreau {

std::string short_number(double value, int digits) {
  if (!std::isfinite(value)) return format_number(value);
  // The text is rounded, not the value: a quotient of powers of ten need not be the nearest number of `digits` digits.
  std::array<char, 32> buffer;
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::scientific, digits - 1).ptr;
  double rounded = value;
  std::from_chars(buffer.data(), end, rounded);
  return format_number(rounded);
}

}  // namespace carreau
