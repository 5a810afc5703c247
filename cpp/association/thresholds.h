// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this folder: their meaning, unit, reason and evidence.
#pragma once

namespace carreau::thresholds::association {

/// Ratio of distances. References whose entities are so much farther apart than entities of like shapes were renumbered. [CarriedMesh.RenumberedFacesAreFound]
inline constexpr double renumbered = 2;
/// Seams of a face whose two sides may have changed places.
inline constexpr int max_seams = 6;

// Refinement (refine_mesh)
/// Length over size above which an edge is halved, and the rounds that halve (2^30 pieces of an edge).
inline constexpr double max_length = 1.4142135623730951;
inline constexpr int max_size_rounds = 30;
/// Evaluations of a middle, and the share of the edge from it that is left.
inline constexpr int middle_steps = 3;
inline constexpr double off_middle = 0.01;
/// Passes of swaps, the gain of quality (Q2) of a swap, and the cosine of the turn that it may make.
inline constexpr int swap_passes = 4;
/// Shape (Q2) of triangles beside curves that are swapped after a halving; regular ones keep the pattern.
inline constexpr double poor_shape = 0.5;
inline constexpr double min_swap_gain = 1e-3, swap_cosine = 0.8;

}  // namespace carreau::thresholds::association
