// SPDX-License-Identifier: BSD-3-Clause
#include "io/plane/tokens.h"

#include <cmath>

#include "io/text.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

bool is_blank(char c) noexcept { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

}  // namespace

Tokens::Tokens(std::string_view text, const std::string& name, const TokenRules& rules) : name_(name) {
  text = without_byte_order_mark(text);
  bool starts_line = true;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == '\n') {
      ++last_line_, ++i, starts_line = true;
    } else if (is_blank(text[i])) {
      ++i;
    } else if (!rules.comment.empty() && text.substr(i).starts_with(rules.comment)) {
      i = std::min(text.find('\n', i), text.size());
    } else {
      std::size_t end = i + 1;
      const auto ends = [&](std::size_t k) {
        return is_blank(text[k]) || text[k] == '\n' || (rules.semicolons && text[k] == ';') ||
               (!rules.comment.empty() && text.substr(k).starts_with(rules.comment));
      };
      if (!(rules.semicolons && text[i] == ';'))
        while (end < text.size() && !ends(end)) ++end;
      tokens_.push_back({text.substr(i, end - i), last_line_, starts_line});
      starts_line = false;
      i = end;
    }
  }
}

void Tokens::fail(int line, const std::string& sentence) const {
  throw FileError({.file = name_, .line = line}, sentence);
}

Token Tokens::word(const char* what) {
  if (at_end()) fail(line(), "the file ends where " + std::string(what) + " was expected");
  return tokens_[next_++];
}

bool Tokens::take(std::string_view word) noexcept {
  if (at_end() || tokens_[next_].text != word) return false;
  ++next_;
  return true;
}

double Tokens::real(const char* what) {
  const Token token = word(what);
  double value = 0;
  if (!parse_number(token.text, value) || !std::isfinite(value))
    fail(token.line, std::string(what) + " was expected, not " + shown(token.text));
  return value;
}

int Tokens::integer(const char* what) {
  const Token token = word(what);
  int value = 0;
  if (!parse_number(token.text, value)) fail(token.line, std::string(what) + " was expected, not " + shown(token.text));
  return value;
}

std::size_t Tokens::count(const char* what, std::size_t words_each) {
  const int at = line(), n = integer(what);
  if (n < 0) fail(at, std::string(what) + " is " + std::to_string(n) + "; it must not be negative");
  if (static_cast<std::size_t>(n) * words_each > left())
    fail(at, std::string(what) + " is " + std::to_string(n) + ", more than the rest of the file can hold");
  return static_cast<std::size_t>(n);
}

void Tokens::skip_line() noexcept {
  while (goes_on()) ++next_;
}

void Tokens::end() {
  if (!at_end()) fail(line(), "the word " + shown(tokens_[next_].text) + " comes after the end");
}

}  // namespace carreau
