// SPDX-License-Identifier: BSD-3-Clause
// Text files of points of space.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace command {

using XYZ = std::array<double, 3>;

/// Three finite numbers with commas or blanks between them; empty: the text is anything else.
std::optional<XYZ> parse_xyz(const std::string& text);

/// The points of a file, one a line. Empty lines and lines that begin with # have none. Throws Failure with file and line.
std::vector<XYZ> read_points(const std::string& path);

}  // namespace command
