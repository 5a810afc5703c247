// SPDX-License-Identifier: BSD-3-Clause
// Triangles with two sides on one smooth curve.
#pragma once

#include "surface/quads/face_quads.h"

namespace carreau {

/// Turns the third side of each triangle that has a flat corner (QuadPatch::flat), where the cells are still triangles
/// and both that come of it are turned the right way in (u, v): from that corner to the vertex beyond. No element of
/// second order can be valid with such a corner, and a quadrilateral that takes the triangle in keeps it. How many.
std::size_t turn_ears(FaceQuads& quads);

}  // namespace carreau
