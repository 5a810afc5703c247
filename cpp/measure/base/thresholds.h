// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this folder: their meaning, unit, reason and evidence.
#pragma once

#include <numbers>

namespace carreau::thresholds::measure {

// In brackets: the tests that rest on it, all of tests/cpp/measure.

/// Unit edges. Gradations are measured over at least this length: over a hundredth of a unit, sizes that differ by an
/// invisible tenth would have a gradation of 14 000. [DeliveredPlane.GradationOfTinyEdgesIsOverATenthOfAUnit]
inline constexpr double shortest_way = 0.1;
/// Unit edges. Trapezoids of a length in a control space are no longer. [DeliveredPlane.QuadratureHasItsOrder]
inline constexpr double fine_length = 0.1;
/// Share of a limit. Values that exceed a limit by less are within it: rounding;
/// [DeliveredPlane.UniformLengthsAreExact]
inline constexpr double limit_rounding = 1e-9;
/// Share of a limit. of gradations, which are measured by trapezoids.
/// [DeliveredPlane.GradationsBetweenTwoCurvesAreForced]
inline constexpr double gradation_tolerance = 0.02;
/// Unit edges. Lengths in range are between these (HDR eq. 2.14). [DeliveredPlane.UniformLengthsAreExact]
inline constexpr double short_limit = std::numbers::sqrt2 / 2, long_limit = std::numbers::sqrt2;

// Meshes of triangles
/// Share of the size. A mesh that is farther from its input triangles has lost a feature, or its sizes do not resolve a
/// curvature: a chord of .8 radii is .1 of its length away. [command_triangles]
inline constexpr double max_share_of_size = 0.1;

// Bounds of A0 and A1 (deviation_bounds)
/// Triangles at work at a time.
inline constexpr std::size_t triangles_at_once = 32768;

}  // namespace carreau::thresholds::measure
