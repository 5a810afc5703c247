// SPDX-License-Identifier: BSD-3-Clause
// Numbers of Gmsh's files: words in the ASCII form, raw bytes in the binary one. Its sections are named by lines of
// text in both.
#pragma once

#include "io/words.h"

namespace carreau {

/// Walks through a file; keeps references to both arguments. Errors are FileErrors.
class MshNumbers : public Words {
 public:
  MshNumbers(std::string_view content, const std::string& name) : Words(content, name), content_(content) {}

  /// From here on numbers are raw. `swapped`: in the byte order that is not the machine's.
  void set_binary(bool swapped) noexcept { binary_ = true, swapped_ = swapped, count_bytes(); }
  [[nodiscard]] bool is_binary() const noexcept { return binary_; }

  /// The place of the next number, for fail().
  [[nodiscard]] const char* here() noexcept {
    if (!binary_) skip_blanks();
    return position();
  }
  std::int32_t integer(const char* what);
  /// A count or the number of a node or element: 64 bits.
  std::int64_t size(const char* what);
  double real(const char* what);
  /// Throws unless n records fit in the rest of the file, each with `words_each` numbers, or `bytes_each` bytes in the
  /// binary form.
  std::size_t checked_count(std::int64_t n, const char* at, const std::string& what, std::size_t words_each,
                            std::size_t bytes_each) const;

  /// Goes behind the word `$End<name>`, which must come next; skip: whatever is before it.
  void end_section(std::string_view name, bool skip);

 private:
  template <typename T>
  T raw(const char* what);

  std::string_view content_;
  bool binary_ = false, swapped_ = false;
};

}  // namespace carreau
