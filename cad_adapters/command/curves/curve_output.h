// SPDX-License-Identifier: BSD-3-Clause
// Files of curves that were cut: meshes of edges, BL2D's C files, drawings.
#pragma once

#include <string>
#include <vector>

#include "curves/curve_input.h"

namespace command {

/// A curve in edges.
struct CutCurve {
  std::int32_t ref = 0;
  std::vector<std::size_t> vertices;  ///< ranks in CutCurves::points
  std::vector<double> abscissae;      ///< of the vertices
  std::vector<Point> support;
};

/// Vertices that are ends of curves come first.
struct CutCurves {
  int dimension = 2;
  std::vector<Point> points;
  std::size_t ends = 0;
  std::vector<CutCurve> curves;
};

/// Medit's text (.mesh), with the edges and the references of their curves.
std::string medit_text(const CutCurves& cut);
/// BL2D's C file (.mc), of dimension 2.
std::string c_file_text(const CutCurves& cut);
/// A drawing (.svg) in the plane (x, y): supports, vertices, and the unit circles of the metrics at the points of the input.
std::string svg_text(const CutCurves& cut, const CurveInput& input, const std::vector<double>& metrics);

}  // namespace command
