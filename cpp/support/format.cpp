// SPDX-License-Identifier: BSD-3-Clause
#include "support/format.h"

#include <array>
#include <charconv>

namespace carreau {

void append_number(std::string& text, double value) {
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  text.append(buffer.data(), end);
}

std::string format_number(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

namespace {

std::string_view without_plus(std::string_view word) {
  // from_chars rejects '+', Fortran and C hosts write it; "+-1" stays wrong.
  if (word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+') word.remove_prefix(1);
  return word;
}

template <typename T>
bool parse_whole(std::string_view word, T& value) {
  T parsed{};
  const char* end = word.data() + word.size();
  const auto result = std::from_chars(word.data(), end, parsed);
  if (word.empty() || result.ec != std::errc{} || result.ptr != end) return false;
  value = parsed;
  return true;
}

}  // namespace

bool parse_number(std::string_view word, double& value) {
  word = without_plus(word);
  constexpr std::size_t longest = 64;
  if (word.size() > longest) return false;
  std::array<char, longest> copy{};
  for (std::size_t i = 0; i < word.size(); ++i) copy[i] = (word[i] == 'd' || word[i] == 'D') ? 'e' : word[i];
  return parse_whole(std::string_view(copy.data(), word.size()), value);
}

bool parse_number(std::string_view word, int& value) { return parse_whole(without_plus(word), value); }

}  // namespace carreau
