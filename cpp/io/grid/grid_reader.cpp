// SPDX-License-Identifier: BSD-3-Clause
// The choice of a reader.
#include <algorithm>

#include "io/files.h"
#include "io/grid/grid_files.h"
#include "io/grid/grid_text.h"
#include "support/error.h"

namespace carreau {

bool is_text(std::string_view content) noexcept {
  constexpr std::size_t looked_at = 4096;
  const std::string_view begin = content.substr(0, looked_at);
  return std::none_of(begin.begin(), begin.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < ' ' && !(byte >= '\t' && byte <= '\r') && byte != '\x1a';
  });
}

void require_text(std::string_view content, const std::string& name) {
  if (!is_text(content)) throw FileError({.file = name}, "the file is binary; text is expected");
}

namespace {

GridFormat format_of(const std::string& path) {
  const std::string suffix = suffix_of(path);
  for (const char* known : {".fmt", ".p3d", ".x", ".grd", ".xyz"})
    if (suffix == known) return GridFormat::plot3d;
  for (const char* known : {".asc", ".dem", ".txt"})
    if (suffix == known) return GridFormat::heights;
  if (suffix == ".cyl") return GridFormat::scan;
  if (suffix == ".ijk") return GridFormat::nodes;
  throw FileError({.file = path},
                  "a grid is read from .fmt, .p3d, .x, .grd, .xyz (PLOT3D), .asc, .dem, .txt (heights), .cyl (a scan) or "
                  ".ijk (nodes)");
}

}  // namespace

grid::Grid read_grid(const std::string& path, GridFormat format, double step) {
  if (format == GridFormat::by_suffix) format = format_of(path);
  const std::string content = read_file(path);
  switch (format) {
    case GridFormat::heights:
      return read_heights(content, path, step);
    case GridFormat::scan:
      return read_scan(content, path, step);
    case GridFormat::nodes:
      return read_nodes(content, path);
    default:
      return read_plot3d(content, path);
  }
}

}  // namespace carreau
