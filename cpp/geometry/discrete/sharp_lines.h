// SPDX-License-Identifier: BSD-3-Clause
// Lines on which a triangulation is sharp, and their corners (HDR sec. 4.9.1).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/discrete/triangulation.h"
#include "model/union_find.h"

namespace carreau::discrete {

struct SharpOptions {
  /// Degrees: edges whose normals differ by more start a line (w_v). Not given: find_sharp_angle().
  std::optional<double> sharp_angle = {};
  double corner_angle = 45;  ///< degrees: a line that turns by more at a vertex has a corner there (180 - w_c)
  /// Only the edges that the input marks, borders and edges with three triangles form lines.
  bool marked_only = false;
  bool references = true;  ///< edges between triangles of different references are sharp
  std::vector<std::int32_t> corners = {};  ///< ascending: vertices on lines that are corners however these turn
};

/// Edges from corner to corner, or a closed line.
struct Line {
  std::vector<std::int32_t> vertices;  ///< the first one again at the end of a closed line without corners
  std::vector<std::int32_t> edges;     ///< indices in Triangulation::edges
  [[nodiscard]] bool closed() const noexcept { return vertices.front() == vertices.back(); }
};

struct SharpLines {
  std::vector<char> sharp;            ///< by edge
  std::vector<std::int32_t> corners;  ///< ascending
  std::vector<Line> lines;
  std::vector<std::int32_t> region;  ///< by triangle: connected over edges that are not sharp, from 0
  std::int32_t regions = 0;
  double sharp_angle = 0;      ///< degrees; the given angle, or the found one
  std::int64_t edges = 0;      ///< that are sharp
  std::int64_t dropped = 0;    ///< potential ones that no line goes through
  std::int64_t prolonged = 0;  ///< regular ones over which lines go on
  std::int64_t faded = 0;      ///< ends of lines on no other one
  std::vector<std::string> sentences = {};
};

/// Corners of triangles, 3 t + k, joined if no sharp edge is between them: a set holds a vertex's corners in one
/// region.
UnionFind sectors_of(const Triangulation& mesh, const std::vector<char>& sharp);

/// Throws InvalidArgument for angles out of ]0, 180].
SharpLines find_sharp_lines(const Triangulation& mesh, const SharpOptions& options = {});

}  // namespace carreau::discrete
