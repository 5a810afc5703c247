// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of the surface of an atlas.
// All of tests/cpp/geometry/atlas rests on them; figures are of the meshes in tests/data.
#pragma once

namespace carreau::atlas::thresholds {

/// Degree of heights, and points that each of their coefficients needs.
inline constexpr int max_degree = 6;
inline constexpr double points_per_term = 1.7;

/// Radius of the bump of a vertex over its longest edge: at 1, bumps cover all triangles.
inline constexpr double bump_radius = 1.5;
/// Charts from the chart of a place to the farthest chart whose bumps may reach it.
inline constexpr int charts_away = 2;

/// Parts of the grid on each T: some 1500 places that charts share. Folds are narrow: of the T of joint.off with folds
/// on this grid, a grid of 24 parts misses two thirds, 48 parts three eighths.
inline constexpr int grid_of_t = 96;
/// If the final check finds folds between its places, the repair starts again on a grid of twice as many parts, up to these.
inline constexpr int finest_grid_of_t = 192;
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
/// Damping of steps (Levenberg and Marquardt), 1 at first, in the unit of anchors: limits.
inline constexpr double min_damping = 1e-6, max_damping = 1e8;

/// The final check: cells of the grid on each T, divisions of a cell that has no bound, divisions of the square around a
/// pure zone before those, and the factor on derivatives that bounds the area between places.
inline constexpr int cells_of_t = 32, cell_divisions = 2, square_divisions = 3;
inline constexpr double fold_safety = 1.5;

}  // namespace carreau::atlas::thresholds
