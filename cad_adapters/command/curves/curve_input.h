// SPDX-License-Identifier: BSD-3-Clause
// Curves of a file: points of a text, joined by splines (RR-2818 sec. 3), or edges of a mesh.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "files/mesh_file.h"

namespace command {

/// A curve of the input.
struct InputCurve {
  std::int32_t ref = 0;
  std::vector<std::size_t> nodes;  ///< ranks of its points in CurveInput::points; a closed curve ends with the first
};

/// The points of a file and the curves through them.
struct CurveInput {
  int dimension = 2;
  bool is_mesh = false;
  std::vector<Point> points;
  std::vector<InputCurve> curves;
};

/// Reads a mesh with edges (BL2D's .smo, .mc, .ms, or a suffix of mesh files), whose curves are chains of edges of one
/// reference, or a text: "x y" or "x y z" a line, an empty line between curves, # and ! start comments. Throws Failure.
CurveInput read_curves(const std::string& path);

/// Metrics at the points, n x 3 (dimension 2) or n x 6: of BL2D's files of sizes (.h, .hc, .hg), or a size a line. Throws Failure.
std::vector<double> read_point_metrics(const std::string& path, const CurveInput& input);

/// The geometric support of a curve.
struct CurveSupport {
  std::vector<Point> points;
  std::vector<double> abscissae;  ///< of the nodes: usual lengths from the first point
  bool loops = false;             ///< a piece of the spline crosses itself (sec. 3.6)
};

/// The nodes of a curve joined by a spline of Catmull and Rom with free ends, or closed (sec. 3.2 and 3.3), as a polyline
/// whose edges of length d are within tolerance * d of it (sec. 3.7); or by segments.
CurveSupport support_of(const CurveInput& input, const InputCurve& curve, bool spline, double tolerance);

}  // namespace command
