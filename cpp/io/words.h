// SPDX-License-Identifier: BSD-3-Clause
// Words and numbers of text files, read with errors that name the line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace carreau {

/// Walks through a text; keeps references to both arguments. Errors are FileErrors.
class Words {
 public:
  /// `comment`: the rest of a line from this character on is skipped; a zero byte: the format has no comments.
  Words(std::string_view text, const std::string& name, char comment = '\0')
      : text_(text), name_(name), p_(text.data()), end_(text.data() + text.size()), comment_(comment) {}

  /// Throws FileError with the line of the character `at`, or with its byte after count_bytes().
  [[noreturn]] void fail(const char* at, const std::string& sentence) const;

  /// Empty at the end of the text.
  std::string_view word();
  /// A finite number; Fortran's exponents are taken too.
  double real(const char* what);
  /// Like real(), but NaN is a number too.
  double real_or_nan(const char* what);
  std::int32_t integer(const char* what);
  std::int64_t integer_64(const char* what);
  /// A number of entities of `words_each` words each: not negative, and no more than the rest of the text can hold.
  std::size_t count(const std::string& what, std::size_t words_each);
  /// Checks a number that was read before. `at`: its end.
  std::size_t checked_count(std::int64_t n, const char* at, const std::string& what, std::size_t words_each) const;
  /// The rest of the line, without blanks at both ends; goes to the next line.
  std::string_view rest_of_line();

  [[nodiscard]] const char* position() const noexcept { return p_; }
  [[nodiscard]] const char* end() const noexcept { return end_; }
  /// Back to an earlier position().
  void go_back(const char* position) noexcept { p_ = position; }

 protected:
  void skip_blanks() noexcept;
  /// The rest has no lines.
  void count_bytes() noexcept { has_lines_ = false; }

 private:
  [[nodiscard]] bool ends_word(char c) const noexcept;
  std::string_view number_word(const char* what);
  template <typename Number>
  bool fast(Number& value);

  std::string_view text_;
  const std::string& name_;
  const char* p_;
  const char* end_;
  char comment_;
  bool has_lines_ = true;
};

}  // namespace carreau
