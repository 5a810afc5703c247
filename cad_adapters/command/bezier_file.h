// Bezier patches in text files, as those of the Utah teapot (.bpt).
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace command {

/// A tensor product of degree m in u and n in v over the unit square.
struct BezierPatch {
  int m = 3, n = 3;
  std::vector<std::array<double, 3>> control;  ///< (m + 1) x (n + 1), row by row; u grows from row to row
};

constexpr int largest_bezier_degree = 15;

/// The number of patches, then for each the degrees m n and (m + 1) (n + 1) points x y z; words are separated by blanks
/// and ends of lines. `name` is the file's, for sentences. Throws Failure with the line.
std::vector<BezierPatch> parse_bezier(std::string_view text, const std::string& name);

}  // namespace command
