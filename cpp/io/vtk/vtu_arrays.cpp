// SPDX-License-Identifier: BSD-3-Clause
#include "io/vtk/vtu_arrays.h"

#include <bit>
#include <cmath>
#include <stdexcept>
#include <type_traits>

#include "io/raw_numbers.h"
#include "io/text.h"
#include "io/vtk/zlib_blocks.h"
#include "support/format.h"

namespace carreau {

namespace {

/// Value of a digit of base64; -1: no digit.
int base64_digit(char c) noexcept {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

}  // namespace

std::string VtuArray::shown_name() const { return "array " + shown(name()); }

VtuArrays::VtuArrays(std::string_view content, const std::string& name, const XmlTag& root)
    : content_(content), name_(name) {
  if (root.attribute("type") != "UnstructuredGrid")
    fail(root, "the type of the file is " + shown(root.attribute("type")) + " instead of 'UnstructuredGrid'");
  if (const std::string compressor = root.attribute("compressor"); !compressor.empty()) {
    if (compressor != "vtkZLibDataCompressor")
      fail(root, "its arrays are compressed by " + shown(compressor) + "; only vtkZLibDataCompressor is known: write the file anew with compressor type ZLib or none");
    compressed_ = true;
  }
  const std::string order = root.attribute("byte_order"), header = root.attribute("header_type");
  if (order != "" && order != "LittleEndian" && order != "BigEndian")
    fail(root, "byte_order is " + shown(order) + " instead of LittleEndian or BigEndian");
  swapped_ = (order == "BigEndian") != (std::endian::native == std::endian::big);
  if (header != "" && header != "UInt32" && header != "UInt64")
    fail(root, "header_type is " + shown(header) + " instead of UInt32 or UInt64");
  length_size_ = header == "UInt64" ? 8 : 4;
}

void VtuArrays::fail(const XmlTag& tag, const std::string& sentence) const {
  Words(content_, name_).fail(tag.at, sentence);
}

void VtuArrays::set_appended(const XmlTag& tag) {
  const std::string encoding = tag.attribute("encoding");
  if (encoding != "raw" && encoding != "base64")
    fail(tag, "the encoding of the data is " + shown(encoding) + " instead of raw or base64");
  appended_ = content_.substr(static_cast<std::size_t>(tag.after - content_.data()));
  const std::size_t start = appended_.find('_');
  if (start == std::string_view::npos) fail(tag, "the data do not begin with an underscore");
  appended_.remove_prefix(start + 1);
  appended_base64_ = encoding == "base64";
  has_appended_ = true;
}

/// Decodes up to the first character that is no digit of base64, or until there are enough bytes. A length may be
/// encoded apart from the data behind it: groups of four that end with '=' are skipped.
std::string VtuArrays::decoded(const VtuArray& array, std::string_view base64, std::uint64_t wanted) const {
  std::string bytes;
  std::uint32_t group = 0;
  int digits = 0, missing = 0;
  for (const char c : base64) {
    if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
    const int digit = base64_digit(c);
    if (digit < 0 && c != '=') break;
    if ((c == '=' && digits < 2) || (c != '=' && missing > 0)) fail(array.tag, array.shown_name() + " is not base64");
    group = group << 6 | static_cast<std::uint32_t>(c == '=' ? 0 : digit);
    if (c == '=') ++missing;
    if (++digits < 4) continue;
    for (int k = 0; k < 3 - missing; ++k) bytes += static_cast<char>(group >> (16 - 8 * k) & 255u);
    group = 0, digits = missing = 0;
    if (bytes.size() >= wanted) return bytes;
  }
  if (digits != 0) fail(array.tag, array.shown_name() + " ends inside a group of base64");
  return bytes;
}

VtuArrays::Stored VtuArrays::stored_of(const VtuArray& array) const {
  if (array.tag.attribute("format") != "appended") return {array.text, true};
  if (!has_appended_) fail(array.tag, array.shown_name() + " lies in AppendedData, which the file does not have");
  double offset = 0;  // exact up to 2^53
  const std::string given = array.tag.attribute("offset");
  if (!parse_number(given, offset) || !(offset >= 0) || offset > static_cast<double>(appended_.size()))
    fail(array.tag, array.shown_name() + " begins at " + shown(given) + ", which is outside of the data");
  return {appended_.substr(static_cast<std::size_t>(offset)), appended_base64_};
}

/// The first n bytes, or as many as there are.
std::string VtuArrays::first(const VtuArray& array, const Stored& stored, std::uint64_t n) const {
  return stored.base64 ? decoded(array, stored.bytes, n)
                       : std::string(stored.bytes.substr(0, static_cast<std::size_t>(n)));
}

/// `length` bytes behind a header.
std::string VtuArrays::behind(const VtuArray& array, const Stored& stored, std::uint64_t header, std::uint64_t length) {
  // Every array has separate bytes: all arrays together need no more than the file holds.
  if (length > content_.size() - taken_)
    fail(array.tag, array.shown_name() + " should have " + std::to_string(length) +
                        " bytes, more than are left: the file may be truncated");
  taken_ += length;
  const std::string bytes = first(array, stored, header + length);
  if (bytes.size() < header + length)
    fail(array.tag, array.shown_name() + " should have " + std::to_string(length) + " bytes, but " +
                        std::to_string(bytes.size() - header) + " are left: the file may be truncated");
  return bytes.substr(static_cast<std::size_t>(header), static_cast<std::size_t>(length));
}

std::uint64_t VtuArrays::header_number(std::string_view header, std::size_t i) const {
  const char* const at = header.data() + i * length_size_;
  return length_size_ == 8 ? raw_number<std::uint64_t>(at, swapped_) : raw_number<std::uint32_t>(at, swapped_);
}

std::string VtuArrays::bytes_of(const VtuArray& array) {
  const Stored stored = stored_of(array);
  const std::string start = first(array, stored, length_size_);
  if (start.size() < length_size_) fail(array.tag, array.shown_name() + " has no length before its bytes");
  const std::uint64_t length = header_number(start, 0);
  return compressed_ ? inflated_bytes(array, stored, length) : behind(array, stored, length_size_, length);
}

std::string VtuArrays::inflated_bytes(const VtuArray& array, const Stored& stored, std::uint64_t blocks) {
  if (blocks == 0) return "";
  if (blocks > content_.size() / length_size_)
    fail(array.tag, array.shown_name() + " should have " + std::to_string(blocks) +
                        " compressed blocks, more than the file holds");
  const std::uint64_t size = (ZlibBlocks::fixed_numbers + blocks) * length_size_;
  const std::string header = first(array, stored, size);
  if (header.size() < size) fail(array.tag, array.shown_name() + " ends before the sizes of its compressed blocks");
  std::vector<std::uint64_t> numbers;
  for (std::size_t i = 0; i < ZlibBlocks::fixed_numbers + blocks; ++i) numbers.push_back(header_number(header, i));
  const ZlibBlocks sizes = ZlibBlocks::of(numbers);
  for (const std::uint64_t each : sizes.compressed)  // before their sum, which could overflow
    if (each > content_.size())
      fail(array.tag, array.shown_name() + " should have a block of " + std::to_string(each) +
                          " bytes, more than are left: the file may be truncated");
  const std::string bytes = behind(array, stored, size, sizes.compressed_size());
  try {
    return inflated(sizes, bytes);
  } catch (const std::runtime_error& error) {
    fail(array.tag, array.shown_name() + ": " + error.what());
  }
}

template <typename T>
std::vector<T> VtuArrays::numbers_of_text(const VtuArray& array, bool finite) const {
  Words in(content_.substr(0, static_cast<std::size_t>(array.text.data() + array.text.size() - content_.data())),
           name_);
  in.go_back(array.text.data());
  std::vector<T> values;
  for (;;) {
    const char* const before = in.position();
    const std::string_view word = in.word();
    if (word.empty()) return values;
    if constexpr (std::is_same_v<T, double>) {
      double value = 0;
      if (!parse_number(word, value)) in.fail(word.data(), "a number was expected, not " + shown(word));
      if (finite && !std::isfinite(value)) in.fail(word.data(), "a number is not finite: " + shown(word));
      values.push_back(value);
    } else {
      in.go_back(before);
      values.push_back(in.integer_64("a number"));
    }
  }
}

template <typename T>
std::vector<T> VtuArrays::numbers_of_bytes(const VtuArray& array, std::string_view bytes) const {
  const std::string type = array.tag.attribute("type");
  std::vector<T> values;
  const auto read = [&]<typename Stored>(Stored) {
    if constexpr (std::is_integral_v<T> && !std::is_integral_v<Stored>) {
      fail(array.tag, array.shown_name() + " has type " + type + " instead of integers");
    } else {
      if (bytes.size() % sizeof(Stored) != 0)
        fail(array.tag, array.shown_name() + " has " + std::to_string(bytes.size()) +
                            " bytes, which are not numbers of " + std::to_string(sizeof(Stored)));
      values.reserve(bytes.size() / sizeof(Stored));
      for (std::size_t i = 0; i < bytes.size(); i += sizeof(Stored))
        values.push_back(static_cast<T>(raw_number<Stored>(bytes.data() + i, swapped_)));
    }
  };
  if (type == "Float64") return read(double{}), values;
  if (type == "Float32") return read(float{}), values;
  if (type == "Int32") return read(std::int32_t{}), values;
  if (type == "Int64") return read(std::int64_t{}), values;
  if (type == "UInt8") return read(std::uint8_t{}), values;
  if (type == "Int8") return read(std::int8_t{}), values;
  if (type == "Int16") return read(std::int16_t{}), values;
  if (type == "UInt16") return read(std::uint16_t{}), values;
  if (type == "UInt32") return read(std::uint32_t{}), values;
  if (type == "UInt64") return read(std::uint64_t{}), values;
  fail(array.tag, array.shown_name() + " has the unknown type " + shown(type));
}

template <typename T>
std::vector<T> VtuArrays::numbers(const VtuArray& array, bool finite) {
  const std::string format = array.tag.attribute("format");
  if (format == "ascii") return numbers_of_text<T>(array, finite);
  if (format != "appended" && format != "binary")
    fail(array.tag, array.shown_name() + " has format " + shown(format) + " instead of ascii, binary or appended");
  std::vector<T> values = numbers_of_bytes<T>(array, bytes_of(array));
  if constexpr (std::is_same_v<T, double>)
    for (const double value : values)
      if (finite && !std::isfinite(value)) fail(array.tag, array.shown_name() + " has a number that is not finite");
  return values;
}

void VtuArrays::check_count(const VtuArray& array, std::size_t found, std::size_t expected) const {
  if (found != expected)
    fail(array.tag,
         array.shown_name() + " has " + std::to_string(found) + " numbers instead of " + std::to_string(expected));
}

std::vector<std::int64_t> VtuArrays::integers(const VtuArray& array, std::size_t count) {
  std::vector<std::int64_t> values = numbers<std::int64_t>(array, true);
  check_count(array, values.size(), count);
  return values;
}

std::vector<std::int64_t> VtuArrays::all_integers(const VtuArray& array) { return numbers<std::int64_t>(array, true); }

std::vector<double> VtuArrays::reals(const VtuArray& array, std::size_t count, bool finite) {
  std::vector<double> values = numbers<double>(array, finite);
  check_count(array, values.size(), count);
  return values;
}

}  // namespace carreau
