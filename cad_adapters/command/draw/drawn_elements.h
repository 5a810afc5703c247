// SPDX-License-Identifier: BSD-3-Clause
// Elements as the flat triangles of a picture.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "draw/view.h"
#include "files/mesh_file.h"

namespace command {

/// A piece of an element: curved ones are drawn as several.
struct DrawnTriangle {
  std::array<Point, 3> corners;
  /// Of the side from each corner to the next: that of the element which it is a part of, by the element's corners
  /// (ends[k], ends[k + 1]); -1: it lies inside.
  std::array<int, 3> side{-1, -1, -1};
  int half = 0;  ///< of a quadrilateral: 0: it is of corners 0, 1, 2, 1: of 0, 2, 3
};

constexpr int usual_pieces = 6;

/// `x`: the positions of the element's nodes. A straight triangle is one, a straight quadrilateral two. `pieces`: of each side
/// of a curved element.
std::vector<DrawnTriangle> drawn(const Element& element, const std::array<Point, 8>& x, int pieces = usual_pieces);

/// sigma of a square over sigma (HDR sec. 1.1.1) of the quadrilateral of four corners: 1 for a square.
double shape_of_quad(const std::array<Point, 8>& corners);

}  // namespace command
