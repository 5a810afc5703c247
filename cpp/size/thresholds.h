// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this folder: their meaning, unit, reason and evidence.
#pragma once

#include <cstddef>

namespace carreau::thresholds::size {

// Guarantees (geo_guarantee)
/// Factors of sizes for which at least 99.5 % of the edges (angle) or triangles (chord) fulfil the criterion, coarse
/// meshes of whole spheres included. None exceeds it by 25 % or 30 %. Edges of a unit mesh are not all of unit length,
/// and a triangle is farther from a sphere than its edges, by 4/3. [tests/cpp/surface/guarantees_test]
inline constexpr double guaranteed_angle_factor = 0.75, guaranteed_chord_factor = 0.65;
/// Factor of sizes for the angle between planes of triangles and tangent planes at their corners (geo_guarantee 2); refine_in_space
/// divides the triangles that exceed it. On a sphere an equilateral triangle stands 2 / sqrt(3) times as steeply as its edges. [tests/cpp/surface/guarantees_test]
inline constexpr double triangle_angle_factor = 0.66;

// Background meshes (background, adapt/transfer)
/// Share of the longest edge of the nearest triangle. Largest distance of a surface from the triangles that approximate
/// it: arcs of 60 degrees are 0.13 of their chord away from it.
/// [BackgroundField.PointsOutsideTakeTheNearestValueAndAreCounted]
inline constexpr double outside_share = 0.125;
/// Number of places at which an attractor is looked for between samples of faces: each costs some lookups a face.
/// [Attractors.PlacesCoverTheElements]
inline constexpr std::size_t max_attractor_places = 2000;
/// Ratio of sizes, from one vertex to the next, above which a place is steep.
/// [BackgroundField.SteepPlacesAreWhereTheFieldJumps]
inline constexpr double steep_ratio = 1.5;

}  // namespace carreau::thresholds::size
