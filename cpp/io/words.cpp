// SPDX-License-Identifier: BSD-3-Clause
#include "io/words.h"

#include <charconv>
#include <cmath>
#include <limits>

#include "io/text.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

constexpr bool is_blank(char c) noexcept { return c == ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

bool Words::ends_word(char c) const noexcept { return is_blank(c) || (comment_ != '\0' && c == comment_); }

void Words::fail(const char* at, const std::string& sentence) const {
  const auto offset = static_cast<std::size_t>(at - text_.data());
  if (!has_lines_) throw FileError({.file = name_}, "byte " + std::to_string(offset) + ": " + sentence);
  throw FileError({.file = name_, .line = line_at(text_, offset)}, sentence);
}

void Words::skip_blanks() noexcept {
  while (p_ != end_) {
    if (comment_ != '\0' && *p_ == comment_)
      while (p_ != end_ && *p_ != '\n') ++p_;
    else if (is_blank(*p_))
      ++p_;
    else
      return;
  }
}

std::string_view Words::word() {
  skip_blanks();
  const char* begin = p_;
  while (p_ != end_ && !ends_word(*p_)) ++p_;
  return {begin, static_cast<std::size_t>(p_ - begin)};
}

std::string_view Words::rest_of_line() {
  const char* begin = p_;
  while (p_ != end_ && *p_ != '\n') ++p_;
  const char* last = p_;
  if (p_ != end_) ++p_;
  while (begin != last && is_blank(*begin)) ++begin;
  while (begin != last && is_blank(last[-1])) --last;
  return {begin, static_cast<std::size_t>(last - begin)};
}

std::string_view Words::number_word(const char* what) {
  const std::string_view found = word();
  if (found.empty()) fail(end_, std::string("the file ends where ") + what + " was expected");
  return found;
}

/// A number as std::from_chars knows it, followed by the end of a word; else nothing is read but blanks.
template <typename Number>
bool Words::fast(Number& value) {
  skip_blanks();
  const auto result = std::from_chars(p_, end_, value);
  if (result.ec != std::errc{} || (result.ptr != end_ && !ends_word(*result.ptr))) return false;
  p_ = result.ptr;
  return true;
}

double Words::real_or_nan(const char* what) {
  double value = 0;
  const char* const before = p_;
  if (fast(value) && !std::isinf(value)) return value;
  p_ = before;
  // The slow path knows Fortran's exponents and the plus sign, and finds the error.
  const std::string_view found = number_word(what);
  if (!parse_number(found, value)) fail(found.data(), std::string(what) + " should be a number, not " + shown(found));
  if (std::isinf(value)) fail(found.data(), std::string(what) + " is not finite: " + shown(found));
  return value;
}

double Words::real(const char* what) {
  skip_blanks();
  const char* const before = p_;
  const double value = real_or_nan(what);
  if (std::isnan(value)) {
    p_ = before;
    const std::string_view found = word();
    fail(found.data(), std::string(what) + " is not finite: " + shown(found));
  }
  return value;
}

std::int32_t Words::integer(const char* what) {
  std::int32_t value = 0;
  if (fast(value)) return value;
  const std::string_view found = number_word(what);
  int parsed = 0;
  if (!parse_number(found, parsed))
    fail(found.data(), std::string(what) + " should be an integer of 32 bits, not " + shown(found));
  return parsed;
}

std::int64_t Words::integer_64(const char* what) {
  std::int64_t value = 0;
  if (fast(value)) return value;
  const std::string_view found = number_word(what);
  fail(found.data(), std::string(what) + " should be an integer, not " + shown(found));
}

std::size_t Words::checked_count(std::int64_t n, const char* at, const std::string& what,
                                 std::size_t words_each) const {
  if (n < 0) fail(at, "the number of " + what + " is negative: " + std::to_string(n));
  // A number takes two characters, its separator included; indices have 32 bits.
  const std::size_t room = static_cast<std::size_t>(end_ - p_) / (2 * words_each);
  if (static_cast<std::uint64_t>(n) > room || n > std::numeric_limits<std::int32_t>::max())
    fail(at, std::to_string(n) + " " + what + " are announced, but the rest of the file has room for at most " +
                 std::to_string(room));
  return static_cast<std::size_t>(n);
}

std::size_t Words::count(const std::string& what, std::size_t words_each) {
  const std::int32_t n = integer(("the number of " + what).c_str());
  return checked_count(n, p_, what, words_each);
}

}  // namespace carreau
