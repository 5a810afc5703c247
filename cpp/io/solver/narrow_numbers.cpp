// SPDX-License-Identifier: BSD-3-Clause
#include "io/solver/narrow_numbers.h"

#include <charconv>
#include <functional>

#include "support/format.h"

namespace carreau {

namespace {

constexpr int max_digits = 17;

/// "1e-07" becomes "1e-7", "1e+30" becomes "1e30".
std::string compact(std::string text) {
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text;
  std::size_t digits = e + 1;
  if (text[digits] == '+') text.erase(digits, 1);
  if (text[digits] == '-') ++digits;
  while (digits + 1 < text.size() && text[digits] == '0') text.erase(digits, 1);
  return text;
}

std::string nastran_form(const std::string& number) {
  std::string text = compact(number);
  const std::size_t e = text.find('e');
  std::string digits = text.substr(0, e);
  std::string power = e == std::string::npos ? "" : text.substr(e + 1);
  if (!power.empty() && power.front() != '-') power.insert(0, "+");
  if (digits.find('.') == std::string::npos) digits += '.';
  const std::size_t sign = digits.front() == '-' ? 1 : 0;
  if (digits.compare(sign, 2, "0.") == 0 && digits.size() > sign + 2) digits.erase(sign, 1);
  return digits + power;
}

std::string with_digits(double value, int digits, std::chars_format format) {
  char text[400];
  const auto end = std::to_chars(text, text + sizeof text, value, format, digits).ptr;
  return {text, end};
}

std::string fitted(double value, std::size_t width, const std::function<std::string(const std::string&)>& form) {
  std::string text = form(format_number(value));
  for (int digits = max_digits; text.size() > width && digits > 0; --digits) {
    text = form(with_digits(value, digits, std::chars_format::general));
    // If the general form starts with zeros, an exponent leaves more room for digits.
    if (text.size() > width) text = form(with_digits(value, digits - 1, std::chars_format::scientific));
  }
  return text;
}

}  // namespace

std::string number_within(double value, std::size_t width) { return fitted(value, width, compact); }

std::string nastran_number(double value, std::size_t width) { return fitted(value, width, nastran_form); }

}  // namespace carreau
