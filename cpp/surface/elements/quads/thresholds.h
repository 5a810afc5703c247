// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of the room, with their units, their reasons and the tests that support them.
// All of tests/cpp/surface/quads rests on them: matching_test, smoothing_test, cleanup_test and quadrilaterals_test, in this order.
#pragma once

#include <cstddef>

namespace carreau::thresholds::quads {

// Charts (quad_patch)
/// Bend a unit (metric/chart.h). Below it a tensor serves a whole cell: an edge's sagitta is less than a fortieth.
inline constexpr double min_bend = 0.05;

// Pairs (pairing)
/// Quality. Worse quadrilaterals are rejected.
inline constexpr double min_pair = 0.08;
/// Edges of sizes by angle_mesh turn by twice that angle from end to end, and so may two triangles.
inline constexpr double turns_per_edge = 2;

// Flat corners (face_quads)
/// Degrees between chords of a curve, and between tangents of two curves, that go on smoothly into each other where
/// they meet. An edge of a sixth of a circle turns by 60 degrees. Sharper corners are kinks, or corners of polygons.
/// [CurvedElements.NoQuadrilateralHasTwoSidesOnOneCircle]
inline constexpr double min_angle_in_curve = 110, min_angle_of_curves = 150;

// Matching
/// Weight of a pair beside its quality: two poor quadrilaterals are better than a good one and two triangles.
inline constexpr double pair_bonus = 0.7;
/// Triangles on an alternating path or circle.
inline constexpr std::size_t longest_path = 10;

// Smoothing
/// Weight of a triangle's proposals beside a quadrilateral's.
inline constexpr double triangle_weight = 0.5;
/// Passes without momentum at the end: they undo the squeezing by momentum.
inline constexpr int plain_passes = 2;
/// Passes over the worst cells.
inline constexpr int worst_passes = 5;

// In space (space_search)
/// Scaled Jacobian, if sizes differ by direction: right angles of the metric need not be right in space.
inline constexpr double poor_jacobian_in_metric = 0.01;
/// Scaled Jacobian below which two triangles are better: angles of 12 and 168 degrees.
inline constexpr double least_jacobian = 0.2;

// Clean-up
/// Passes of smoothing around changes, before the next pass.
inline constexpr int passes_after_changes = 3;

}  // namespace carreau::thresholds::quads
