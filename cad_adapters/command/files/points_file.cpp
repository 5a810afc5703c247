// SPDX-License-Identifier: BSD-3-Clause
#include "files/points_file.h"

#include <charconv>
#include <cmath>
#include <sstream>

#include "base/failure.h"
#include "base/text_file.h"

namespace command {

std::optional<XYZ> parse_xyz(const std::string& text) {
  XYZ point{};
  const char *at = text.data(), *const end = text.data() + text.size();
  const auto skip = [&](bool commas) {
    while (at != end && (*at == ' ' || *at == '\t' || *at == '\r' || (commas && (*at == ',' || *at == ';')))) ++at;
  };
  for (std::size_t k = 0; k < 3; ++k) {
    skip(k > 0);
    if (at != end && *at == '+') ++at;
    const auto [rest, error] = std::from_chars(at, end, point[k]);
    if (error != std::errc() || !std::isfinite(point[k])) return {};
    at = rest;
  }
  skip(false);
  return at == end ? std::optional(point) : std::nullopt;
}

std::vector<XYZ> read_points(const std::string& path) {
  std::istringstream text(read_text(path));
  std::vector<XYZ> points;
  std::string line;
  for (std::size_t n = 1; std::getline(text, line); ++n) {
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || line[first] == '#') continue;
    const std::optional<XYZ> point = parse_xyz(line);
    if (!point) throw Failure(path + ", line " + std::to_string(n) + ": three numbers x y z are required, not '" + line.substr(0, 60) + "'.");
    points.push_back(*point);
  }
  if (points.empty()) throw Failure("'" + path + "' has no point.");
  return points;
}

}  // namespace command
