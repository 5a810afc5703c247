// Thresholds of the room: what they are, in which unit, why, and what supports them.
#pragma once

#include <cstddef>

namespace carreau::thresholds::quads {

// Charts (quad_patch)
/// Bend a unit (metric/chart.h). Below it a tensor serves a whole cell: an edge's sagitta is less than a fortieth.
inline constexpr double least_bend = 0.05;

// Pairs (pairing)
/// Quality. Worse quadrilaterals are no candidates.
inline constexpr double least_pair = 0.08;
/// Edges of sizes by angle_mesh turn by twice that angle from end to end, and so may two triangles.
inline constexpr double turns_per_edge = 2;

// Matching
/// Weight of a pair beside its quality: two poor quadrilaterals are better than a good one and two triangles.
inline constexpr double pair_bonus = 0.7;
/// Triangles on an alternating path or circle.
inline constexpr std::size_t longest_path = 12;
/// Least gain that counts, more than rounding.
inline constexpr double least_gain = 1e-9;
/// A path that has lost so much on its way is given up.
inline constexpr double most_loss = 2.5;
inline constexpr int most_rounds = 20;
inline constexpr int searches_between_checks = 4096;

// Smoothing
/// Of what a triangle proposes beside a quadrilateral.
inline constexpr double triangle_weight = 0.5;
inline constexpr std::size_t cells_between_checks = 4096;
/// Passes over the worst cells.
inline constexpr int worst_passes = 5;

}  // namespace carreau::thresholds::quads
