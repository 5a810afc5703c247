// SPDX-License-Identifier: BSD-3-Clause
// Normals of regions at vertices, and curves over edges (HDR sec. 4.9.2).
#pragma once

#include <vector>

#include "geometry/discrete/gregory.h"
#include "geometry/discrete/sharp_lines.h"
#include "geometry/discrete/triangulation.h"

namespace carreau::discrete {

/// Normals and tangents from which curves are made.
struct Frames {
  std::vector<Vec3> normal;   ///< by corner 3 t + k: of the region there, of unit length
  std::vector<double> reach;  ///< by corner: shortest extent of a triangle that turns the normal; infinite if none does
  std::vector<Vec3> tangent;  ///< by vertex: of the line through it, of unit length; zero elsewhere and at corners
};

/// Normals by eq. 4.96, tangents of lines by eq. 4.99. The tangent is the polyline's if normals beside a line nearly
/// agree, or if the line has one side or more than two. The normals are then made orthogonal to it.
Frames find_frames(const Triangulation& mesh, const SharpLines& lines);

/// Curves of all edges, from the smaller vertex on: eq. 4.97 on regular edges, 4.99 and 4.100 on sharp ones. Normals at
/// corners become the normals of the planes that the two lines beside span.
std::vector<Cubic> find_curves(const Triangulation& mesh, const SharpLines& lines, Frames& frames);

/// Eq. 4.97 and 4.98. `np`, `nq`: of unit length.
Cubic curve_by_normals(const Vec3& p, const Vec3& q, const Vec3& np, const Vec3& nq) noexcept;

}  // namespace carreau::discrete
