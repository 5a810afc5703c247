// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of the surface of an atlas.
// All of tests/cpp/geometry/atlas rests on them; figures are of the meshes in tests/data.
#pragma once

namespace carreau::atlas::thresholds {

/// Degree of heights, and points that each of their coefficients needs.
inline constexpr int max_degree = 6;
inline constexpr double points_per_term = 1.7;

/// Rings of neighbours for the heights about a vertex, and the cosine of the steepest normal among them.
inline constexpr int rings = 3;
inline constexpr double min_cosine = 0.25;
/// Radius of the ellipsoid of a vertex over its longest edge: at 1, ellipsoids cover all triangles.
inline constexpr double bump_radius = 1.5;
/// Rings around the vertices of a region whose ellipsoids may reach a place of it.
inline constexpr int rings_away = 2;

/// Area of the surface over the area of its charts' planes: below, a place counts as turned over. The bound is above 0,
/// because nearly folded places are meshed poorly.
inline constexpr double least_jacobian = 0.25;
/// Target for moved charts; above the last value, because distances pull back.
inline constexpr double wanted_jacobian = 0.5;
/// Places above this value are not watched while charts move. If one folds nevertheless, the next round finds it.
inline constexpr double watched_jacobian = 0.7;

/// Weight of distances from the initial positions, 1 at first: factor of each round, and minimum.
inline constexpr double loosening = 0.3, min_anchor = 1e-4;
/// Steps of a round. Joint.off and spot need one round, the bunny three; the weight of distances is least after eight.
inline constexpr int mend_steps = 30;

/// The final check: cells of the grid on each T, cells along a narrow strip between two knots of phi or of borders, divisions of the square around a pure
/// zone before a place counts, divisions of a cell without a bound, and the factor on derivatives that bounds the area between places.
/// All cells of spheres, tori and ellipsoids have a bound after six divisions; a cell that has none after fourteen is rejected.
inline constexpr int cells_of_t = 32, cells_of_strip = 16, square_divisions = 4, cell_divisions = 14;
inline constexpr double fold_safety = 1.5;

}  // namespace carreau::atlas::thresholds
