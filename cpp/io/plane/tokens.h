// SPDX-License-Identifier: BSD-3-Clause
// Words of the files of plane domains, with their lines.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace carreau {

struct Token {
  std::string_view text;
  int line = 1;
  bool starts_line = false;
};

/// Separators and ends of words besides blanks.
struct TokenRules {
  std::string_view comment;  ///< the rest of a line from here on is skipped; empty: there are no comments
  bool semicolons = false;   ///< each is a separate word
};

/// Walks through the words of a text; keeps references to both arguments. Errors are FileErrors with file and line.
class Tokens {
 public:
  Tokens(std::string_view text, const std::string& name, const TokenRules& rules);

  [[nodiscard]] bool at_end() const noexcept { return next_ == tokens_.size(); }
  [[nodiscard]] std::size_t left() const noexcept { return tokens_.size() - next_; }
  /// The line of the next word, or of the end of the text.
  [[nodiscard]] int line() const noexcept { return at_end() ? last_line_ : tokens_[next_].line; }
  /// True if the next word is on the line of the previous word.
  [[nodiscard]] bool goes_on() const noexcept { return !at_end() && !tokens_[next_].starts_line; }
  /// Throws at the end of the text.
  Token word(const char* what);
  /// Takes the next word if it is this one.
  bool take(std::string_view word) noexcept;
  double real(const char* what);
  int integer(const char* what);
  /// Not negative, and so small that the rest of the text can hold as many entities of `words_each` words.
  std::size_t count(const char* what, std::size_t words_each);
  void skip_line() noexcept;
  /// Throws unless the text is over.
  void end();
  [[noreturn]] void fail(int line, const std::string& sentence) const;

 private:
  const std::string& name_;
  std::vector<Token> tokens_;
  std::size_t next_ = 0;
  int last_line_ = 1;
};

}  // namespace carreau
