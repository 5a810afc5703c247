// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this room, with their units, their reasons and the tests that support them.
// tests/cpp/surface/remesh/certification_test rests on them.
#pragma once

#include <cstdint>

namespace carreau::thresholds::certify {

/// Share of a tolerance. Triangles whose normals at corners give a smaller share are not suspect: on a smooth surface the error is about a
/// fifth.
inline constexpr double suspect_share = 0.5;
/// Share of a tolerance. Smaller shares are within: measures see triangles from places that differ a little.
inline constexpr double within = 0.98;
/// Ratio. Allowed growth of the largest share of a group if other triangles come within tolerances.
inline constexpr double max_growth = 1.05;
/// Share of the excess over tolerances of a group that may be left.
inline constexpr double min_success = 0.5;
/// Share of a tolerance. Moves do not help triangles that are farther beyond it.
inline constexpr double max_moved = 1.3;
/// Shape (Q2) that an edit may leave after better shapes, also a split before further splits.
inline constexpr double min_shape = 0.3;
/// Lengths. Shorter edges are not split. A bend beyond the tolerance over half of that length is a feature of another size.
inline constexpr double shortest_split = 0.3;
/// The loss for a mesh that is worse: edits do not repair a surface that bends within a size everywhere.
inline constexpr double max_mean_lost = 0.04;
/// Shares of the size: steps of moves; directions of them.
inline constexpr double steps[] = {0.15, 0.3};
inline constexpr int directions = 6;
/// Shape. Gains below do not count. Passes over triangles below remesh::good_enough, at last below remesh::good_shape.
inline constexpr double min_shape_gain = 0.01;
inline constexpr int tidy_passes = 2, tidy_passes_at_last = 5;

/// Evaluations of the surface, for each triangle of the mesh and for each triangle of a group beyond tolerances. Triangles that stay beyond
/// are reported. So many for each triangle take as long as the mesh of the patches: it evaluates less and computes more. The last number is
/// allowed in any case: a tenth of a second.
inline constexpr std::int64_t max_evaluations = 28, max_evaluations_of_group = 5250, always_evaluations = 175'000;

}  // namespace carreau::thresholds::certify
