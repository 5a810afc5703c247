// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "io/grid/grid_files.h"
#include "io/grid/grid_text.h"
#include "io/text.h"
#include "io/words.h"
#include "predicates/clamped_int.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

using grid::Block;
using grid::Grid;
using grid::Measured;

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

/// The places of the values of a regular grid.
struct Raster {
  int columns = 0, rows = 0;
  double dx = 1, dy = 1, x = 0, y = 0;
};

std::vector<std::string_view> words_of_line(std::string_view line, const std::string& name) {
  std::vector<std::string_view> found;
  Words words(line, name);
  for (std::string_view word = words.word(); !word.empty(); word = words.word()) found.push_back(word);
  return found;
}

/// The next line that has words; and the start of the rest.
struct Line {
  std::vector<std::string_view> words;
  std::size_t end = 0;
};

Line first_line(std::string_view text, std::size_t from, const std::string& name) {
  while (from < text.size()) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    Line line{words_of_line(text.substr(from, end - from), name), std::min(end + 1, text.size())};
    if (!line.words.empty()) return line;
    from = line.end;
  }
  return {{}, text.size()};
}

void check_raster(const Raster& raster, const std::string& name, const Words& words, const char* at) {
  if (raster.columns < 2 || raster.rows < 2)
    words.fail(at, "the grid has " + std::to_string(raster.columns) + " x " + std::to_string(raster.rows) +
                       " nodes; a surface needs two rows and two columns");
  if (!(raster.dx > 0) || !(raster.dy > 0) || !std::isfinite(raster.dx + raster.dy + raster.x + raster.y))
    words.fail(at, "the step of the grid must be finite and positive");
  const auto room = static_cast<std::uint64_t>(words.end() - words.position()) / 2 + 1;
  if (static_cast<std::uint64_t>(raster.columns) * static_cast<std::uint64_t>(raster.rows) > room)
    throw FileError({.file = name}, std::to_string(raster.columns) + " x " + std::to_string(raster.rows) +
                                        " nodes are announced, more than the file can hold");
}

void expect_end(Words& words) {
  if (const std::string_view more = words.word(); !more.empty())
    words.fail(more.data(), "the file goes on behind the last node: " + shown(more));
}

/// The header lines of an ESRI grid: a key and a number each.
struct EsriHeader {
  Raster raster;
  double no_data = -9999;
  bool centres = false;

  bool take(std::string key, double value) {
    for (char& c : key) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    if (key == "ncols")
      raster.columns = clamped_int(value, 0, std::numeric_limits<int>::max());
    else if (key == "nrows")
      raster.rows = clamped_int(value, 0, std::numeric_limits<int>::max());
    else if (key == "cellsize")
      raster.dx = raster.dy = value;
    else if (key == "dx")
      raster.dx = value;
    else if (key == "dy")
      raster.dy = value;
    else if (key == "xllcorner" || key == "xllcenter")
      raster.x = value, centres = key == "xllcenter";
    else if (key == "yllcorner" || key == "yllcenter")
      raster.y = value;
    else if (key == "nodata_value")
      no_data = value;
    else
      return false;
    return true;
  }
};

Grid read_esri(std::string_view text, const std::string& name) {
  Words words(text, name);
  EsriHeader header;
  const char* const start = words.position();
  for (;;) {
    const char* const before = words.position();
    const std::string_view key = words.word();
    double value = 0;
    if (key.empty() || parse_number(key, value)) {
      words.go_back(before);
      break;
    }
    value = words.real("a value of the header");
    constexpr double most = 1e9;
    if (!(std::abs(value) < most) && (key[0] == 'n' || key[0] == 'N') && key.size() == 5)
      words.fail(key.data(), "the count is too large");
    if (!header.take(std::string(key), value)) words.fail(key.data(), "the header has no word " + shown(key));
  }
  Raster& raster = header.raster;
  check_raster(raster, name, words, start);
  if (!header.centres) raster.x += raster.dx / 2, raster.y += raster.dy / 2;  // heights are values of cells
  Block block{.columns = raster.columns, .rows = raster.rows, .nodes = {}, .measured = Measured::heights};
  block.nodes.resize(static_cast<std::size_t>(raster.columns) * static_cast<std::size_t>(raster.rows));
  for (int j = raster.rows - 1; j >= 0; --j)
    for (int i = 0; i < raster.columns; ++i) {
      const double z = words.real_or_nan("a height");
      block.nodes[block.index(i, j)] = {raster.x + i * raster.dx, raster.y + j * raster.dy,
                                        z == header.no_data ? missing : z};
    }
  expect_end(words);
  return {.blocks = {std::move(block)}, .source = name};
}

Grid read_rows(Words& words, const Raster& raster, const std::string& name) {
  Block block{.columns = raster.columns, .rows = raster.rows, .nodes = {}, .measured = Measured::heights};
  block.nodes.reserve(static_cast<std::size_t>(raster.columns) * static_cast<std::size_t>(raster.rows));
  for (int j = 0; j < raster.rows; ++j)
    for (int i = 0; i < raster.columns; ++i)
      block.nodes.emplace_back(raster.x + i * raster.dx, raster.y + j * raster.dy, words.real_or_nan("a height"));
  expect_end(words);
  return {.blocks = {std::move(block)}, .source = name};
}

/// A matrix without a header.
Grid read_matrix(std::string_view text, const std::string& name, double step) {
  Raster raster{.dx = step, .dy = step};
  for (std::size_t from = 0;;) {
    const Line line = first_line(text, from, name);
    if (line.words.empty()) break;
    if (raster.columns == 0) raster.columns = static_cast<int>(line.words.size());
    if (static_cast<std::size_t>(raster.columns) != line.words.size())
      throw FileError({.file = name, .line = line_at(text, static_cast<std::size_t>(line.words[0].data() - text.data()))},
                      "the row has " + std::to_string(line.words.size()) + " heights, the first one has " +
                          std::to_string(raster.columns));
    ++raster.rows;
    from = line.end;
  }
  Words words(text, name);
  check_raster(raster, name, words, text.data());
  return read_rows(words, raster, name);
}

/// The first line of plain text: counts, and optional numbers behind them. Empty: it is no header.
std::optional<Raster> header_of(const Line& line, double step) {
  constexpr std::size_t most = 6;
  if (line.words.size() < 2 || line.words.size() > most || line.words.size() == 5) return {};
  Raster raster{.dx = step, .dy = step};
  if (!parse_number(line.words[0], raster.columns) || !parse_number(line.words[1], raster.rows)) return {};
  if (raster.columns < 2 || raster.rows < 2) return {};
  std::array<double*, 4> values{&raster.dx, &raster.dy, &raster.x, &raster.y};
  for (std::size_t k = 2; k < line.words.size(); ++k)
    if (!parse_number(line.words[k], *values[k - 2])) return {};
  if (line.words.size() == 3) raster.dy = raster.dx;
  return raster;
}

}  // namespace

Grid read_heights(std::string_view text, const std::string& name, double step) {
  require_text(text, name);
  text = without_byte_order_mark(text);
  const Line first = first_line(text, 0, name);
  if (first.words.empty()) throw FileError({.file = name, .line = 1}, "the file is empty");
  double number = 0;
  if (first.words.size() == 2 && !parse_number(first.words[0], number)) return read_esri(text, name);
  constexpr std::size_t record = 1024;
  if (!parse_number(first.words[0], number) && text.size() > record) return read_usgs_dem(text, name);
  const std::optional<Raster> header = header_of(first, step);
  if (!header || first_line(text, first.end, name).words.size() == first.words.size())
    return read_matrix(text, name, step);
  Words words(text, name);
  for (std::size_t k = 0; k < first.words.size(); ++k) words.word();
  check_raster(*header, name, words, text.data());
  return read_rows(words, *header, name);
}

Grid read_scan(std::string_view text, const std::string& name, double step) {
  require_text(text, name);
  text = without_byte_order_mark(text);
  const Line first = first_line(text, 0, name);
  const std::optional<Raster> header = header_of(first, step);
  if (!header)
    throw FileError({.file = name, .line = 1}, "the first line of a scan is 'angles heights [dz [z]]'");
  Words words(text, name);
  for (std::size_t k = 0; k < first.words.size(); ++k) words.word();
  const double bottom = first.words.size() > 3 ? header->dy : 0;
  const Raster raster{.columns = header->columns, .rows = header->rows, .dx = header->dx, .dy = header->dx, .y = bottom};
  check_raster(raster, name, words, text.data());
  Block block{.columns = raster.columns + 1, .rows = raster.rows, .nodes = {}, .measured = Measured::radii};
  for (int j = 0; j < raster.rows; ++j) {
    for (int i = 0; i < raster.columns; ++i) {
      const double r = words.real_or_nan("a distance"), angle = 2 * std::numbers::pi * i / raster.columns;
      if (r <= 0) words.fail(words.position() - 1, "the distance from the axis is " + format_number(r) + "; it must be positive");
      block.nodes.emplace_back(r * std::cos(angle), r * std::sin(angle), bottom + j * raster.dx);
    }
    block.nodes.push_back(block.nodes[block.nodes.size() - static_cast<std::size_t>(raster.columns)]);
  }
  expect_end(words);
  return {.blocks = {std::move(block)}, .source = name};
}

}  // namespace carreau
