// SPDX-License-Identifier: BSD-3-Clause
#include "io/model/bezier_reader.h"

#include <charconv>
#include <cmath>

#include "io/files.h"
#include "support/error.h"

namespace carreau {
namespace {

class Words {
 public:
  Words(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  [[noreturn]] void fail(const std::string& why) const {
    throw FileError(Where{.file = name_, .line = line_}, why);
  }

  template <typename Number>
  Number number(const char* what) {
    const std::string_view word = next();
    if (word.empty()) fail(std::string("the file ends where ") + what + " should be");
    Number value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size())
      fail(std::string(what) + " should be where '" + printable(word) + "' stands");
    return value;
  }

  double coordinate() {
    const auto x = number<double>("a coordinate");
    // Squares of lengths must still be numbers.
    if (!std::isfinite(x) || std::abs(x) > 1e100) fail("a coordinate is not a number below 1e100");
    return x;
  }

  bool at_end() {
    skip();
    return text_.empty();
  }

 private:
  static bool blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

  void skip() {
    while (!text_.empty() && blank(text_.front())) {
      if (text_.front() == '\n') ++line_;
      text_.remove_prefix(1);
    }
  }

  std::string_view next() {
    skip();
    std::size_t length = 0;
    while (length < text_.size() && !blank(text_[length])) ++length;
    const std::string_view word = text_.substr(0, length);
    text_.remove_prefix(length);
    return word;
  }

  /// A printable form of a word of any bytes.
  static std::string printable(std::string_view word) {
    std::string shown;
    for (const char c : word.substr(0, 20)) shown += c >= ' ' && c <= '~' ? c : '?';
    if (word.size() > 20) shown += "...";
    return shown;
  }

  std::string_view text_;
  const std::string& name_;
  int line_ = 1;
};

}  // namespace

std::vector<BezierPatch> parse_bezier(std::string_view text, const std::string& name) {
  Words words(text, name);
  const auto count = words.number<int>("the number of patches");
  if (count < 1) words.fail("there are " + std::to_string(count) + " patches, so that there is no face to mesh");
  std::vector<BezierPatch> patches;  // grows with the file, whatever it announces
  for (int k = 0; k < count; ++k) {
    BezierPatch patch;
    patch.m = words.number<int>("a degree");
    patch.n = words.number<int>("a degree");
    for (const int degree : {patch.m, patch.n})
      if (degree < 1 || degree > largest_bezier_degree)
        words.fail("the degree " + std::to_string(degree) + " of patch " + std::to_string(k + 1) +
                   " is not from 1 to " + std::to_string(largest_bezier_degree));
    for (int i = 0; i < (patch.m + 1) * (patch.n + 1); ++i) {
      const double x = words.coordinate(), y = words.coordinate(), z = words.coordinate();
      patch.control.emplace_back(x, y, z);
    }
    patches.push_back(std::move(patch));
  }
  if (!words.at_end()) words.fail("there is more than the " + std::to_string(count) + " patches that are announced");
  return patches;
}

std::vector<BezierPatch> read_bezier(const std::string& path) { return parse_bezier(read_file(path), path); }

}  // namespace carreau
