// SPDX-License-Identifier: BSD-3-Clause
#include "io/medit/gmf_sections.h"

#include <cmath>
#include <limits>

#include "io/raw_numbers.h"
#include "support/error.h"

namespace carreau {

namespace {

constexpr std::int32_t swapped_one = 0x01000000;

}  // namespace

void GmfSections::fail(std::size_t at, const std::string& sentence) const {
  throw FileError({.file = name_}, "byte " + std::to_string(at) + ": " + sentence);
}

/// The next number, whole within the file.
template <typename T>
T GmfSections::raw() {
  if (bytes_.size() - pos_ < sizeof(T)) fail(bytes_.size(), "the file ends inside a number");
  const T value = raw_number<T>(bytes_.data() + pos_, swap_);
  pos_ += sizeof(T);
  return value;
}

std::int32_t GmfSections::reference() {
  const std::size_t at = pos_;
  const std::int64_t value = sized(sizes_.index);
  if (value < std::numeric_limits<std::int32_t>::min() || value > std::numeric_limits<std::int32_t>::max())
    fail(at, "the number " + std::to_string(value) + " does not fit in 32 bits");
  return static_cast<std::int32_t>(value);
}

double GmfSections::real(const char* what) {
  const std::size_t at = pos_;
  const double value = sizes_.real == 4 ? static_cast<double>(raw<float>()) : raw<double>();
  if (!std::isfinite(value)) fail(at, std::string(what) + " is not finite");
  return value;
}

std::size_t GmfSections::checked_count(std::int64_t n, std::size_t at, const char* what, std::size_t record) const {
  const std::size_t room = pos_ <= section_end_ ? (section_end_ - pos_) / record : 0;
  if (pos_ > section_end_ || n < 0 || static_cast<std::uint64_t>(n) > room ||
      n > std::numeric_limits<std::int32_t>::max())
    fail(at, std::to_string(n) + " " + what + " are announced, but there is room for " + std::to_string(room));
  return static_cast<std::size_t>(n);
}

void GmfSections::header() {
  if (bytes_.size() < 8) fail(bytes_.size(), "the file ends inside the header");
  const auto cookie = raw<std::int32_t>();
  swap_ = cookie == swapped_one;
  if (cookie != 1 && !swap_) fail(0, "the file does not start with the mark of a binary mesh");
  const auto version = raw<std::int32_t>();
  if (version < 1 || version > 4) fail(4, "version " + std::to_string(version) + " is not one of 1, 2, 3, 4");
  sizes_ = gmf_sizes(version);
}

std::int32_t GmfSections::next() {
  if (section_end_ != 0) {
    if (pos_ > section_end_) fail(section_start_, "section " + std::to_string(code_) + " is longer than its header states");
    pos_ = section_end_;  // skips the unread rest
  }
  section_start_ = pos_;
  if (bytes_.size() - pos_ < 4 + sizes_.position) fail(bytes_.size(), "the file ends before the section End");
  code_ = raw<std::int32_t>();
  const std::int64_t end = sized(sizes_.position);
  if (code_ == static_cast<std::int32_t>(GmfCode::end)) return code_;
  // Sections are in ascending order: every writer does so, and it prevents loops.
  if (end < static_cast<std::int64_t>(pos_) || static_cast<std::uint64_t>(end) > bytes_.size())
    fail(section_start_,
         "section " + std::to_string(code_) + " ends at " + std::to_string(end) + ", which is outside of the file");
  section_end_ = static_cast<std::size_t>(end);
  return code_;
}

std::int32_t GmfSections::dimension() {
  const std::size_t at = pos_;
  const auto found = raw<std::int32_t>();
  if (found != 2 && found != 3) fail(at, "the dimension is " + std::to_string(found) + " instead of 2 or 3");
  return found;
}

template std::int32_t GmfSections::raw<std::int32_t>();
template std::int64_t GmfSections::raw<std::int64_t>();

}  // namespace carreau
