// SPDX-License-Identifier: BSD-3-Clause
// Arrays of a VTK XML file: numbers as text, as base64, or as bytes behind the XML.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/vtk/xml_tags.h"

namespace carreau {

struct VtuArray {
  XmlTag tag;
  std::string_view text;  ///< between the tags
  [[nodiscard]] std::string name() const { return tag.attribute("Name"); }
  [[nodiscard]] std::string shown_name() const;
};

/// The storage of the numbers of a file, and their places.
class VtuArrays {
 public:
  /// Keeps references to both arguments. `root`: the tag VTKFile. Throws FileError for unknown forms.
  VtuArrays(std::string_view content, const std::string& name, const XmlTag& root);

  /// The tag AppendedData. Throws FileError.
  void set_appended(const XmlTag& tag);

  /// `count` numbers; any that a 64-bit integer holds. Throws FileError.
  [[nodiscard]] std::vector<std::int64_t> integers(const VtuArray& array, std::size_t count);
  /// finite: NaN and infinity are errors.
  [[nodiscard]] std::vector<double> reals(const VtuArray& array, std::size_t count, bool finite);
  /// However many there are.
  [[nodiscard]] std::vector<std::int64_t> all_integers(const VtuArray& array);

  [[noreturn]] void fail(const XmlTag& tag, const std::string& sentence) const;

 private:
  template <typename T>
  std::vector<T> numbers_of_text(const VtuArray& array, bool finite) const;
  template <typename T>
  std::vector<T> numbers_of_bytes(const VtuArray& array, std::string_view bytes) const;
  template <typename T>
  std::vector<T> numbers(const VtuArray& array, bool finite);
  /// The bytes of an array and the text behind them.
  struct Stored {
    std::string_view bytes;
    bool base64 = false;
  };
  [[nodiscard]] Stored stored_of(const VtuArray& array) const;
  [[nodiscard]] std::string first(const VtuArray& array, const Stored& stored, std::uint64_t n) const;
  [[nodiscard]] std::string behind(const VtuArray& array, const Stored& stored, std::uint64_t header,
                                   std::uint64_t length);
  [[nodiscard]] std::string bytes_of(const VtuArray& array);
  [[nodiscard]] std::string inflated_bytes(const VtuArray& array, const Stored& stored, std::uint64_t blocks);
  [[nodiscard]] std::string decoded(const VtuArray& array, std::string_view base64, std::uint64_t wanted) const;
  /// Number i of the header before the bytes of an array.
  [[nodiscard]] std::uint64_t header_number(std::string_view header, std::size_t i) const;
  void check_count(const VtuArray& array, std::size_t found, std::size_t expected) const;

  std::string_view content_;
  const std::string& name_;
  bool swapped_ = false;
  std::size_t length_size_ = 4;  // bytes of the length before the bytes of an array
  std::string_view appended_;    // behind the underscore
  bool compressed_ = false;      // by zlib
  bool has_appended_ = false, appended_base64_ = false;
  std::uint64_t taken_ = 0;  // bytes of arrays so far
};

}  // namespace carreau
