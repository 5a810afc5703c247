// SPDX-License-Identifier: BSD-3-Clause
#include "io/gmsh/msh_numbers.h"

#include <cmath>
#include <limits>

#include "io/raw_numbers.h"
#include "io/text.h"

namespace carreau {

template <typename T>
T MshNumbers::raw(const char* what) {
  const char* at = position();
  if (static_cast<std::size_t>(end() - at) < sizeof(T))
    fail(end(), std::string("the file ends where ") + what + " was expected");
  go_back(at + sizeof(T));
  return raw_number<T>(at, swapped_);
}

std::int32_t MshNumbers::integer(const char* what) { return binary_ ? raw<std::int32_t>(what) : Words::integer(what); }

std::int64_t MshNumbers::size(const char* what) { return binary_ ? raw<std::int64_t>(what) : integer_64(what); }

double MshNumbers::real(const char* what) {
  if (!binary_) return Words::real(what);
  const char* at = position();
  const auto value = raw<double>(what);
  if (!std::isfinite(value)) fail(at, std::string(what) + " is not finite");
  return value;
}

std::size_t MshNumbers::checked_count(std::int64_t n, const char* at, const std::string& what, std::size_t words_each,
                                      std::size_t bytes_each) const {
  if (!binary_) return Words::checked_count(n, at, what, words_each);
  const std::size_t room = static_cast<std::size_t>(end() - position()) / bytes_each;
  if (n < 0 || static_cast<std::uint64_t>(n) > room || n > std::numeric_limits<std::int32_t>::max())
    fail(at, std::to_string(n) + " " + what + " are announced, but the rest of the file has room for at most " +
                 std::to_string(room));
  return static_cast<std::size_t>(n);
}

void MshNumbers::end_section(std::string_view name, bool skip) {
  const std::string last = "$End" + std::string(name);
  if (skip) {
    const std::size_t found = content_.find(last, static_cast<std::size_t>(position() - content_.data()));
    if (found == std::string_view::npos) fail(end(), "the file ends before " + last + ": it may be truncated");
    go_back(content_.data() + found);
  }
  const std::string_view found = word();
  if (found.empty()) fail(end(), "the file ends before " + last + ": it may be truncated");
  if (found != last) fail(found.data(), last + " was expected, not " + shown(found));
}

}  // namespace carreau
