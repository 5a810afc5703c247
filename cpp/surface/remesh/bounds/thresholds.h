// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this room, with their units, their reasons and the tests that support them.
#pragma once

namespace carreau::thresholds::bounds {

// In brackets: the tests that rest on it, all of tests/cpp/measure.

/// Share of the way from a corner to the place. Closest points are so near to the exact ones along the surface. A distance that is a
/// hundredth of the way is right to a part in 20 000. [CrossPatchElements.MeasuresAreOfTheElements]
inline constexpr double near_foot = 1e-4;

// Bounds of A0 and A1 (triangle_bound, deviation_bounds)
/// Least share of a triangle's bend that its quarters have: a difference of zero does not bound derivatives.
inline constexpr double min_of_parent = 0.5;
/// Share of the largest observed deviation by which a bound may exceed it before the triangle is cut. The bound of a sphere exceeds it by
/// less.
inline constexpr double bound_gap = 0.2;
/// The share if the bound is beyond the tolerance: finer bounds must decide.
inline constexpr double bound_gap_beyond = 0.05;
/// The share if only the bound is beyond the tolerance, and the observed deviation is within.
inline constexpr double bound_gap_undecided = 0.005;
/// Times that a part of a triangle is cut into four, and number of parts of a triangle: after that bounds stay.
inline constexpr int max_cuts = 10, max_parts = 150;
/// Number of parts of a triangle that is known to be beyond a tolerance, if the caller needs no more than that.
inline constexpr int max_parts_beyond = 16;
/// Ratio of these to the parts that are cut when an edit is only tested. [time only]
inline constexpr int roughly_parts = 4;

}  // namespace carreau::thresholds::bounds
