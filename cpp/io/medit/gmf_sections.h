// SPDX-License-Identifier: BSD-3-Clause
// Sections of a GMF binary file (.meshb, .solb), read with errors that name the byte.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "io/medit/gmf.h"

namespace carreau {

/// Walks through a file; keeps references to both arguments. Errors are FileErrors.
class GmfSections {
 public:
  GmfSections(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  /// Throws FileError with the offset.
  [[noreturn]] void fail(std::size_t at, const std::string& sentence) const;

  /// Mark of the format and version, either byte order.
  void header();
  /// Goes to the content of the next section, even if the previous section was not read to its end; returns its code,
  /// or `end`.
  std::int32_t next();

  [[nodiscard]] std::size_t position() const noexcept { return pos_; }
  [[nodiscard]] const GmfSizes& sizes() const noexcept { return sizes_; }

  std::int32_t integer() { return raw<std::int32_t>(); }
  /// An index or a reference; it must fit in 32 bits.
  std::int32_t reference();
  /// A finite number. `what`: "a coordinate".
  double real(const char* what);
  /// Number of records of a section.
  std::int64_t announced() { return sized(sizes_.count); }
  /// Throws unless `n` records of that many bytes fit in the rest of the section. `at`: the place of n.
  std::size_t checked_count(std::int64_t n, std::size_t at, const char* what, std::size_t record) const;
  std::size_t count(const char* what, std::size_t record) {
    const std::size_t at = pos_;
    return checked_count(announced(), at, what, record);
  }
  /// 2 or 3.
  std::int32_t dimension();

 private:
  template <typename T>
  T raw();
  std::int64_t sized(std::size_t size) { return size == 8 ? raw<std::int64_t>() : raw<std::int32_t>(); }

  std::string_view bytes_;
  const std::string& name_;
  std::size_t pos_ = 0, section_start_ = 0, section_end_ = 0;
  std::int32_t code_ = 0;
  bool swap_ = false;
  GmfSizes sizes_{};
};

}  // namespace carreau
