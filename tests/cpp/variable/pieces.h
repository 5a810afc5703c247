// SPDX-License-Identifier: BSD-3-Clause
// Pieces to deform, and checks of every remeshed piece.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "variable/remesh.h"

namespace carreau::testing {

/// The domain on the left of closed polygons, meshed with sizes h(x, y) in edges of about that length.
variable::Piece meshed(const std::vector<std::vector<Vec2>>& loops, const std::function<double(Vec2)>& h);
/// A circle in n edges, counterclockwise.
std::vector<Vec2> circle(Vec2 centre, double radius, int n);
/// A polygon in edges of length h or a little less.
std::vector<Vec2> polygon(const std::vector<Vec2>& corners, double h);
variable::Piece disc(Vec2 centre, double radius, double h);

/// Options of a piece without tools, damage or fields.
variable::RemeshInput input_of(variable::Piece piece, double h_min, double h_max);

/// Empty when the result is a mesh: triangles counterclockwise (exactly), no multiple vertex, edges on its boundary,
/// kinds and parts that fit. No node is inside a tool, and bound nodes are within 1e-3 h_min of their tools.
std::vector<std::string> find_defects(const variable::RemeshInput& input, const variable::RemeshResult& result);

struct PieceQuality {
  double q2_mean = 0, q2_worst = 1;
  double in_range = 0;  ///< share of edges of length [1/sqrt 2, sqrt 2] in `size`
};
PieceQuality quality_of(const variable::Piece& piece, const std::function<double(Vec2)>& size);

}  // namespace carreau::testing
