// SPDX-License-Identifier: BSD-3-Clause
// Shape and size of one triangle.
#pragma once

#include "files/mesh_file.h"

namespace command {

/// 4 sqrt(3) area / sum of squared edges (Q2 of HDR eq. 1.6): 1 for an equilateral triangle, 0 for a flat one.
double shape_quality(const Point& a, const Point& b, const Point& c);

/// Size of a triangle: the side of the equilateral one of the same area.
double size_of(const Point& a, const Point& b, const Point& c);

}  // namespace command
