// SPDX-License-Identifier: BSD-3-Clause
// The elevation models of USGS: records of 1024 characters.
#include <cmath>
#include <limits>

#include "io/grid/grid_files.h"
#include "io/grid/grid_text.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

using grid::Block;
using grid::Grid;

constexpr std::size_t record_length = 1024;

/// Numbers in columns, counted from 1 as the description of the format does.
class Record {
 public:
  Record(std::string_view text, std::size_t start, const std::string& name) : text_(text), start_(start), name_(name) {}

  [[nodiscard]] double real(std::size_t column, std::size_t width, const char* what) const {
    if (start_ + column - 1 + width > text_.size()) fail(std::string("the file ends where ") + what + " was expected");
    std::string word(text_.substr(start_ + column - 1, width));
    const std::size_t first = word.find_first_not_of(' ');
    word = first == std::string::npos ? "" : word.substr(first, word.find_last_not_of(' ') - first + 1);
    double value = 0;
    if (!parse_number(word, value) || !std::isfinite(value)) fail(std::string(what) + " should be a number");
    return value;
  }
  [[nodiscard]] int integer(std::size_t column, std::size_t width, const char* what) const {
    const double value = real(column, width, what);
    if (std::abs(value) > std::numeric_limits<int>::max() || value != std::floor(value))
      fail(std::string(what) + " should be an integer");
    return static_cast<int>(value);
  }
  [[noreturn]] void fail(const std::string& sentence) const {
    throw FileError({.file = name_}, "byte " + std::to_string(start_) + ": " + sentence);
  }

 private:
  std::string_view text_;
  std::size_t start_;
  const std::string& name_;
};

struct Profile {
  double x = 0, y = 0;
  std::vector<double> heights;
};

/// Reads a profile and goes to the record behind it.
Profile read_profile(std::string_view text, std::size_t& start, double unit, const std::string& name) {
  constexpr std::size_t first_block = 146, next_block = 170, width = 6, header = 145;
  constexpr int no_data = -32767;
  const Record record(text, start, name);
  const int n = record.integer(13, width, "the number of heights of a profile");
  if (n < 1 || static_cast<std::size_t>(n) * width > text.size() - start) record.fail("the profile has " + std::to_string(n) + " heights");
  Profile profile{.x = record.real(25, 24, "x of a profile"), .y = record.real(49, 24, "y of a profile"), .heights = {}};
  const double datum = record.real(73, 24, "the datum of a profile");
  std::size_t column = header, left = first_block;
  for (int k = 0; k < n; ++k, --left, column += width) {
    if (left == 0) start += record_length, column = 1, left = next_block;
    const int height = Record(text, start, name).integer(column, width, "a height");
    profile.heights.push_back(height == no_data ? std::numeric_limits<double>::quiet_NaN() : datum + unit * height);
  }
  start += record_length;
  return profile;
}

}  // namespace

Grid read_usgs_dem(std::string_view text, const std::string& name) {
  require_text(text, name);
  const Record header(text, 0, name);
  const double dx = header.real(817, 12, "the step in x"), dy = header.real(829, 12, "the step in y"),
               unit = header.real(841, 12, "the unit of heights");
  const int columns = header.integer(859, 6, "the number of profiles");
  if (!(dx > 0) || !(dy > 0) || !(unit > 0)) header.fail("the steps of the grid must be positive");
  if (columns < 2 || static_cast<std::size_t>(columns) * record_length > text.size())
    header.fail("the number of profiles is " + std::to_string(columns) + ", which the file cannot hold");
  std::vector<Profile> profiles;
  for (std::size_t start = record_length; static_cast<int>(profiles.size()) < columns;)
    profiles.push_back(read_profile(text, start, unit, name));
  double low = profiles[0].y, high = low;
  for (const Profile& p : profiles)
    low = std::min(low, p.y), high = std::max(high, p.y + dy * static_cast<double>(p.heights.size() - 1));
  const double rows = std::round((high - low) / dy) + 1;
  if (!(rows >= 2) || rows * columns > static_cast<double>(text.size())) header.fail("profiles do not lie beside one another");
  Block block{.columns = columns, .rows = static_cast<int>(rows), .nodes = {}, .measured = grid::Measured::heights};
  for (int j = 0; j < block.rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const Profile& p = profiles[static_cast<std::size_t>(i)];
      const double k = std::round((low + j * dy - p.y) / dy);
      const bool there = k >= 0 && k < static_cast<double>(p.heights.size());
      block.nodes.emplace_back(profiles[0].x + i * dx, low + j * dy,
                               there ? p.heights[static_cast<std::size_t>(k)] : std::numeric_limits<double>::quiet_NaN());
    }
  return {.blocks = {std::move(block)}, .source = name};
}

}  // namespace carreau
