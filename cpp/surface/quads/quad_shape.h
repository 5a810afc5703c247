// SPDX-License-Identifier: BSD-3-Clause
// Shapes of quadrilaterals (HDR sec. 1.1.1).
#pragma once

#include <array>

#include "surface/quads/quad_patch.h"

namespace carreau {

/// (2 + 2 sqrt 2) / sigma, sigma = h / rho (HDR sec. 1.1.1): h is the diameter, rho the least inradius of the four
/// triangles of two edges that meet. 1 for a square; 0 unless it is strictly convex and counterclockwise.
double quad_quality(const std::array<Vec2, 4>& p) noexcept;
/// The same in space, for what is counterclockwise about the normal of the quadrilateral's diagonals.
double quad_quality(const std::array<Vec3, 4>& p) noexcept;
/// Least sine of the angles at the corners; below 0 where one is turned over.
double scaled_jacobian(const std::array<Vec2, 4>& p) noexcept;
double scaled_jacobian(const std::array<Vec3, 4>& p) noexcept;

/// Strictly convex and counterclockwise in (u, v), exactly; of triangles: counterclockwise.
bool is_convex(const QuadPatch& patch, const MixedCell& cell) noexcept;
/// Whether two sides of it are edges of curves that go on smoothly into each other (QuadPatch::flat).
bool has_flat_corner(const QuadPatch& patch, const MixedCell& cell) noexcept;
/// Quality in the metric: of a triangle Q2 (HDR eq. 1.6).
double cell_quality(const QuadPatch& patch, const FaceCharts& charts, const MixedCell& cell) noexcept;
/// The same in a given chart.
double cell_quality(const QuadPatch& patch, const Chart& chart, const MixedCell& cell) noexcept;

/// The same, and below 0 the scaled Jacobian, for cells that are turned over somewhere: what a search can follow.
double untangling_quality(const QuadPatch& patch, const Chart& chart, const MixedCell& cell) noexcept;

}  // namespace carreau
