// SPDX-License-Identifier: BSD-3-Clause
// Bezier patches in text files, for example the Utah teapot (.bpt).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "geometry/bezier/bezier_patch.h"

namespace carreau {

/// The number of patches, then for each the degrees m n and (m + 1) (n + 1) points x y z. Blanks and ends of lines
/// separate words. `name` is the file's, for sentences. Throws FileError with the line.
std::vector<BezierPatch> parse_bezier(std::string_view text, const std::string& name);

/// Throws FileError.
std::vector<BezierPatch> read_bezier(const std::string& path);

}  // namespace carreau
