// SPDX-License-Identifier: BSD-3-Clause
// Tensor-product Bezier patches.
#pragma once

#include <vector>

#include "cad/cad.h"
#include "support/vec.h"

namespace carreau {

/// Highest degree in a direction. Sums of Bernstein polynomials are convex combinations, so that the degree costs no
/// accuracy; it costs time and the size of arrays.
inline constexpr int largest_bezier_degree = 15;

/// A tensor product of degree m in u and n in v over the unit square.
struct BezierPatch {
  int m = 3, n = 3;
  std::vector<Vec3> control;  ///< (m + 1) x (n + 1), row by row; u grows from row to row
};

/// Sets the members of `want` (a set of Want bits), exact but for rounding. The other members of the jet are not
/// touched.
void evaluate(const BezierPatch& patch, unsigned want, const Vec2& uv, SurfaceJet& jet);

}  // namespace carreau
